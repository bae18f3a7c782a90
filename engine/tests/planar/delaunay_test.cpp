#include <cmath>
#include <random>
#include <set>

#include "engine/planar/points.h"
#include "engine/tests/planar/planar_test_plane.h"

namespace ccdt {
namespace {

using namespace planar_test;

void expect_unique_delaunay(const IntegerPlane& plane) {
  std::vector<VertexId> vertices = all_vertices(plane);
  const planar::TriangulationResult first = planar::delaunay<IntegerPlane>(vertices, plane);
  ASSERT_TRUE(first);
  expect_sound(first.triangulation, plane);
  expect_empty_circles(first.triangulation, plane);
  const std::size_t border = planar::border_edges(first.triangulation).size();
  EXPECT_EQ(first.triangulation.triangles.size() + border + 2, 2 * vertices.size());  // Euler

  std::mt19937 random(5);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(vertices.begin(), vertices.end(), random);
    const planar::TriangulationResult again = planar::delaunay<IntegerPlane>(vertices, plane);
    EXPECT_EQ(canonical(again.triangulation), canonical(first.triangulation));
  }
}

TEST(PlanarDelaunay, IsUniqueForRandomPoints) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) expect_unique_delaunay(random_points(60, 100000, seed));
}

TEST(PlanarDelaunay, IsUniqueForFewPointsWithManyTies) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    IntegerPlane plane = random_points(5 + seed % 12, 5, seed);
    const auto vertices = all_vertices(plane);
    if (planar::delaunay<IntegerPlane>(vertices, plane).status == planar::TriangulationResult::Status::collinear)
      continue;
    expect_unique_delaunay(plane);
  }
}

TEST(PlanarDelaunay, IsUniqueForASquareGrid) {
  expect_unique_delaunay(square_grid(9));
}

TEST(PlanarDelaunay, IsUniqueForAGridWithShuffledIds) {
  IntegerPlane plane = square_grid(8);
  std::mt19937 random(3);
  std::shuffle(plane.points.begin(), plane.points.end(), random);
  expect_unique_delaunay(plane);
}

TEST(PlanarDelaunay, IsUniqueForPointsOnOneCircle) {
  const IntegerPlane plane = circle_points(5 * 13 * 17);
  ASSERT_EQ(plane.points.size(), 108u);
  expect_unique_delaunay(plane);
}

TEST(PlanarDelaunay, IsUniqueForALineAndOnePointBesideIt) {
  IntegerPlane plane;
  for (std::int64_t i = 0; i < 30; ++i) plane.points.push_back({3 * i, 2 * i});
  plane.points.push_back({10, 40});
  expect_unique_delaunay(plane);
}

TEST(PlanarDelaunay, IsUniqueForTwoParallelLines) {
  IntegerPlane plane;
  for (std::int64_t i = 0; i < 25; ++i) plane.points.insert(plane.points.end(), {{i, 0}, {i * i, 1}});
  expect_unique_delaunay(plane);
}

TEST(PlanarDelaunay, OfThreePointsIsOneCounterclockwiseTriangle) {
  const IntegerPlane plane{{{0, 0}, {0, 5}, {5, 0}}};
  const auto result = planar::delaunay<IntegerPlane>(all_vertices(plane), plane);
  ASSERT_TRUE(result);
  EXPECT_EQ(canonical(result.triangulation), Triangles{triangle(0, 2, 1)});
}

TEST(PlanarDelaunay, OfASquareHasTheDiagonalThatTheSmallestIdDecides) {
  // Raising the lifted point of vertex 0 takes it off the lower hull of the others: the diagonal avoids it.
  const IntegerPlane plane{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const auto result = planar::delaunay<IntegerPlane>(all_vertices(plane), plane);
  ASSERT_TRUE(result);
  EXPECT_EQ(canonical(result.triangulation), (Triangles{triangle(0, 1, 3), triangle(1, 2, 3)}));
}

TEST(PlanarDelaunay, ReportsThatAllAreCollinear) {
  IntegerPlane plane;
  for (std::int64_t i = 0; i < 40; ++i) plane.points.push_back({2 * i, 3 * i});
  const auto result = planar::delaunay<IntegerPlane>(all_vertices(plane), plane);
  EXPECT_EQ(result.status, planar::TriangulationResult::Status::collinear);
  EXPECT_TRUE(result.triangulation.triangles.empty());
  plane.points.resize(2);
  EXPECT_EQ(planar::delaunay<IntegerPlane>(all_vertices(plane), plane).status,
            planar::TriangulationResult::Status::collinear);
  EXPECT_EQ(planar::delaunay<IntegerPlane>({}, plane).status, planar::TriangulationResult::Status::collinear);
}

TEST(PlanarDelaunay, ReportsVerticesAtTheSamePlace) {
  for (std::uint32_t copied = 0; copied < 12;
       ++copied) {  // each in turn, because the algorithm reaches corners of the hull in another way
    for (const std::size_t at : {std::size_t{0}, std::size_t{6}, std::size_t{12}}) {
      IntegerPlane plane = random_points(12, 50, 9);
      const IntegerPoint copy = plane.points[copied];
      plane.points.insert(plane.points.begin() + static_cast<std::ptrdiff_t>(at), copy);
      EXPECT_EQ(planar::delaunay<IntegerPlane>(all_vertices(plane), plane).status,
                planar::TriangulationResult::Status::duplicates);
    }
  }
}

/// The effort is measured in evaluations of the predicates, which no load of the machine can change.
void expect_few_evaluations(const IntegerPlane& plane) {
  plane.calls = 0;
  const auto result = planar::delaunay<IntegerPlane>(all_vertices(plane), plane);
  ASSERT_TRUE(result);
  const auto n = static_cast<double>(plane.points.size());
  EXPECT_LT(static_cast<double>(plane.calls), 10 * n * std::log2(n));
}

TEST(PlanarDelaunay, EvaluatesFewPredicatesForManyPoints) {
  expect_few_evaluations(random_points(100000, 1 << 20, 1));
  expect_few_evaluations(square_grid(316));
  IntegerPlane parabola;
  for (std::int64_t i = 0; i < 20000; ++i) parabola.points.push_back({i, i * i / 400});
  expect_few_evaluations(parabola);
}

TEST(PlanarPoints, AgreeWithTheIntegerModel) {
  const IntegerPlane plane = square_grid(17);  // 16 across: rounding to the grid changes nothing
  std::vector<planar::Point2> points;
  for (const IntegerPoint& p : plane.points)
    points.push_back({100 + 0.125 * static_cast<double>(p.x), 0.125 * static_cast<double>(p.y)});
  const planar::Points rounded(points);
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    std::set<VertexId> ids;
    while (ids.size() < 4) ids.emplace(random() % plane.points.size());
    std::vector<VertexId> v(ids.begin(), ids.end());
    std::shuffle(v.begin(), v.end(), random);
    EXPECT_EQ(rounded.orient(v[0], v[1], v[2]), plane.orient(v[0], v[1], v[2]));
    EXPECT_EQ(rounded.incircle(v[0], v[1], v[2], v[3]), plane.incircle(v[0], v[1], v[2], v[3]));
  }
}

TEST(PlanarPoints, TriangulateAnyCoordinates) {
  std::mt19937 random(4);
  std::vector<planar::Point2> points;
  std::vector<VertexId> vertices;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double angle = random() * 1e-9, radius = 1e-7 * std::sqrt(random());
    points.push_back({1e3 + radius * std::cos(angle), -2 + radius * std::sin(angle)});
    vertices.emplace_back(i);
  }
  const planar::Points plane(points);
  const auto first = planar::delaunay<planar::Points>(vertices, plane);
  ASSERT_TRUE(first);
  std::shuffle(vertices.begin(), vertices.end(), random);
  EXPECT_EQ(canonical(planar::delaunay<planar::Points>(vertices, plane).triangulation), canonical(first.triangulation));
}

}  // namespace
}  // namespace ccdt
