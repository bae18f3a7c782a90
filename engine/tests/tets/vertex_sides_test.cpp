#include "engine/tets/vertex_sides.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/geometry/predicates.h"

namespace ccdt {
namespace {

using tets::Corner, tets::Sides, tets::VertexSides;

/// Random points of a grid with `places` positions in each direction. On a small grid, many points are coplanar.
std::vector<Point3> random_points(std::size_t count, double places, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0, places);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({std::floor(place(random)), std::floor(place(random)), std::floor(place(random))});
  return points;
}

void expect_sides_of_all_triangles(const std::vector<Point3>& points) {
  VertexSides sides;
  sides.find(points);
  const auto n = static_cast<Corner>(points.size());
  for (Corner a = 0; a < n; ++a)
    for (Corner b = 0; b < n; ++b)
      for (Corner c = 0; c < n; ++c)
        for (Corner d = 0; d < n && a != b && b != c && c != a; ++d)
          ASSERT_EQ(sides.of(a, b, c).side(d), orient3d(points[a], points[b], points[c], points[d]));
}

TEST(VertexSides, AreThoseOfOrient3d) {
  std::mt19937 random(1);
  for (const std::size_t count : {4, 5, 7, 8, 13, 32})
    for (const double places : {2.0, 5.0, 1000.0, 0x1p50})
      expect_sides_of_all_triangles(random_points(count, places, random));
}

TEST(VertexSides, ForgetThePointsBefore) {
  std::mt19937 random(2);
  VertexSides sides;
  sides.find(random_points(VertexSides::most_vertices, 100, random));
  sides.find(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_EQ(sides.of(0, 1, 2).above, tets::corner_bit(3));
  EXPECT_EQ(sides.of(0, 1, 2).below, 0u);
}

TEST(VertexSides, KnowTheEdgesThatPassThroughATriangle) {
  // Points above and below the triangle of the first three: over its inside, over its border, and beside it.
  const std::vector<Point3> points = {{0, 0, 0}, {9, 0, 0},  {0, 9, 0}, {3, 3, 5}, {3, 3, -5},
                                      {3, 0, 5}, {3, 0, -5}, {8, 8, 5}, {8, 8, -5}};
  VertexSides sides;
  sides.find(points);
  EXPECT_TRUE(sides.is_around({0, 1, 2}, 3, 4));
  EXPECT_TRUE(sides.is_around({1, 2, 0}, 4, 3));
  EXPECT_FALSE(sides.is_around({0, 1, 2}, 5, 6));
  EXPECT_FALSE(sides.is_around({2, 0, 1}, 5, 6));
  EXPECT_FALSE(sides.is_around({0, 1, 2}, 7, 8));
}

}  // namespace
}  // namespace ccdt
