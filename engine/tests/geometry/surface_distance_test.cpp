#include "engine/geometry/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/geometry/closest_point.h"

namespace ccdt {
namespace {

using Triangles = std::vector<TrianglePoints>;

/// A graph over the unit square with n x n cells of two triangles.
template <class Height>
Triangles graph(int n, const Height& height, bool turned = false) {
  Triangles triangles;
  const auto at = [&](int i, int j) {
    const double x = double(i) / n, y = double(j) / n;
    return Point3{x, y, height(x, y)};
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Point3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (turned)
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
      else
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  return triangles;
}

double flat(double, double) {
  return 0;
}
double curved(double x, double y) {
  return 0.3 * std::sin(3 * x) * std::cos(2 * y);
}

/// The largest distance of many points of one surface from the other: a lower bound.
double sampled(const Triangles& from, const Triangles& to, int n) {
  double most = 0;
  for (const TrianglePoints& t : from)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Point3 p = weighted_point({1 - double(i + j) / n, double(i) / n, double(j) / n}, t);
        double least = HUGE_VAL;
        for (const TrianglePoints& other : to) least = std::min(least, squared_distance(other, p));
        most = std::max(most, least);
      }
  return std::sqrt(most);
}

FarthestPoint farthest(const Triangles& from, const Triangles& to, double absolute = 1e-9) {
  return farthest_point(from, NearestTriangle(to), {.absolute = absolute});
}

TEST(SurfaceDistance, OfOtherTrianglesOfAFlatFacetIsNothing) {
  EXPECT_LT(farthest(graph(7, flat), graph(12, flat, true)).bound, 1e-9);
  EXPECT_LT(farthest(graph(1, flat), graph(40, flat)).bound, 1e-9);
  EXPECT_LT(farthest(graph(40, flat), graph(1, flat)).bound, 1e-9);
  EXPECT_LT(farthest(graph(5, curved), graph(5, curved)).bound, 1e-14);
}

TEST(SurfaceDistance, OfParallelPlatesIsTheirDistance) {
  const double bound = farthest(graph(5, flat), graph(9, [](double, double) { return 0.125; })).bound;
  EXPECT_GE(bound, 0.125);
  EXPECT_LE(bound, 0.125 * 1.031);
}

TEST(SurfaceDistance, OfCurvedSurfacesIsTightOnBothSides) {
  const Triangles coarse = graph(4, curved), fine = graph(13, curved, true);
  for (const auto& [from, to] : {std::pair(coarse, fine), std::pair(fine, coarse)}) {
    const FarthestPoint found = farthest(from, to);
    const double least = sampled(from, to, 12);
    EXPECT_GE(found.bound, least);
    EXPECT_LE(found.bound, 1.06 * least);
    EXPECT_LE(found.reached, found.bound);
    EXPECT_NEAR(sampled({{found.at, found.at, found.at}}, to, 1), found.reached, 1e-12);
  }
}

TEST(SurfaceDistance, SeesWhatOnlyOneOfTheSurfacesHas) {
  const auto with_spike = [](double x, double y) { return x == 0.5 && y == 0.5 ? 0.25 : 0.0; };
  const FarthestPoint found = farthest(graph(10, with_spike), graph(3, flat));
  EXPECT_NEAR(found.bound, 0.25, 0.01);
  EXPECT_EQ(found.at, (Point3{0.5, 0.5, 0.25}));
  Triangles hole = graph(10, flat);
  hole.erase(hole.begin() + 80, hole.begin() + 120);
  EXPECT_LT(farthest(hole, graph(3, flat)).bound, 1e-9);
  EXPECT_NEAR(farthest(graph(3, flat), hole).bound, 0.1, 0.004);
}

TEST(SurfaceDistance, IsNeverLessThanThatOfAPoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 1);
  const auto soup = [&](int count) {
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
      TrianglePoints t;
      for (Point3& p : t) p = {coordinate(random), coordinate(random), coordinate(random)};
      triangles.push_back(t);
    }
    return triangles;
  };
  for (int round = 0; round < 20; ++round) {
    const Triangles from = soup(3), to = soup(2 + 3 * round);
    const FarthestPoint found = farthest(from, to);
    EXPECT_GE(found.bound, sampled(from, to, 30)) << round;
    EXPECT_LE(found.bound, 1.031 * found.reached) << round;
  }
}

}  // namespace
}  // namespace ccdt
