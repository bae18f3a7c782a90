#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "engine/delaunay/delaunay.h"
#include "engine/geometry/predicates.h"
#include "engine/tests/delaunay/delaunay_checks.h"
#include "engine/tests/delaunay/delaunay_point_sets.h"

namespace ccdt {
namespace {

using namespace test;

TEST(BuildDelaunay, GivesTheCellsOfTheDefinitionWhateverTheIdsAre) {
  for (const NamedPoints& set : tiny_sets()) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const delaunay::Delaunay d = delaunay::build_delaunay(shuffled(set.points, seed));
      EXPECT_EQ(sorted_cells(d), cells_by_definition(d.vertices)) << set.name << ", order " << seed;
    }
  }
}

TEST(BuildDelaunay, GivesTheCellsOfTheDefinitionForManySmallLattices) {
  int flat = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    auto points = shuffled(seed % 2 ? simple_cubic(2, 2) : face_centered(1, 2), seed);
    points.resize(std::min<std::size_t>(points.size(), 6 + seed % 7));
    try {
      const delaunay::Delaunay d = delaunay::build_delaunay(points);
      ASSERT_EQ(sorted_cells(d), cells_by_definition(d.vertices)) << seed;
    } catch (const MeshError&) {
      for (const Point3& p : points) EXPECT_EQ(orient3d(points[0], points[1], points[2], p), 0) << seed;
      ++flat;
    }
  }
  EXPECT_LT(flat, 30);
}

TEST(BuildDelaunay, LeavesSpheresAndOuterHalfSpacesEmpty) {
  for (const NamedPoints& set : small_sets()) {
    const delaunay::Delaunay d = delaunay::build_delaunay(set.points);
    EXPECT_TRUE(is_consistent(d)) << set.name;
    EXPECT_TRUE(has_empty_spheres(d)) << set.name;
  }
}

TEST(BuildDelaunay, KeepsItsStructureConsistentForManyPoints) {
  EXPECT_TRUE(is_consistent(delaunay::build_delaunay(random_points(30000, 21))));
  EXPECT_TRUE(is_consistent(delaunay::build_delaunay(face_centered(18))));
}

TEST(BuildDelaunay, FillsACubeOfAnyLattice) {
  const auto volume = [](const delaunay::Delaunay& d) {
    double six_fold = 0;
    for (std::uint32_t c = 0; c < d.cells.size(); ++c) {
      if (!d.is_finite(c)) continue;
      const auto& v = d.cells[c].vertices;
      const Point3& a = d.point(v[0]);
      six_fold += dot(cross(d.point(v[1]) - a, d.point(v[2]) - a), d.point(v[3]) - a);
    }
    return six_fold / 6;
  };
  EXPECT_EQ(volume(delaunay::build_delaunay(simple_cubic(9, 2))), 18 * 18 * 18);
  EXPECT_EQ(volume(delaunay::build_delaunay(body_centered(7, 2))), 14 * 14 * 14);
  EXPECT_EQ(volume(delaunay::build_delaunay(face_centered(6, 2))), 12 * 12 * 12);
}

TEST(BuildDelaunay, KeepsPointsInTheirPlacesAndGivesEachARank) {
  const auto points = random_points(5000, 22);
  const delaunay::Delaunay d = delaunay::build_delaunay(points);
  ASSERT_EQ(d.vertices.size(), points.size());
  std::set<std::uint32_t> ranks;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    ASSERT_EQ(d.vertices[v].point, points[v]);
    ranks.insert(d.vertices[v].rank);
  }
  EXPECT_EQ(ranks.size(), points.size());
  EXPECT_EQ(*ranks.rbegin(), points.size() - 1);
}

TEST(BuildDelaunay, DependsOnThePointsAlone) {
  for (const NamedPoints& set : small_sets())
    EXPECT_TRUE(are_equal(delaunay::build_delaunay(set.points), delaunay::build_delaunay(set.points))) << set.name;
}

TEST(BuildDelaunay, RefusesPointsWithoutABody) {
  std::vector<Point3> plane;
  for (const Point3& p : random_points(100, 23)) plane.push_back({p.x, p.y, 12345});
  EXPECT_THROW(delaunay::build_delaunay(plane), MeshError);
  std::vector<Point3> slanted;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) slanted.push_back({7.0 * i, 3.0 * j, 5.0 * i - 11.0 * j});
  EXPECT_THROW(delaunay::build_delaunay(slanted), MeshError);
  std::vector<Point3> line;
  for (int i = 0; i < 10; ++i) line.push_back({7.0 * i, 3.0 * i, 5.0 * i});
  EXPECT_THROW(delaunay::build_delaunay(line), MeshError);
  EXPECT_THROW(delaunay::build_delaunay(std::span(slanted).first(3)), MeshError);
  EXPECT_THROW(delaunay::build_delaunay({}), MeshError);
}

}  // namespace
}  // namespace ccdt
