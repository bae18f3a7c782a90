#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/mesher.h"
#include "engine/tests/front/front_stages.h"
#include "engine/tests/shared/mesh_test_solids.h"

namespace ccdt {
namespace {

using namespace mesh_test;

/// A triangle and two points close above and below it. The segment between these two pierces the triangle and is a
/// Delaunay edge.
plc::InputPlc flat_bipyramid() {
  plc::InputPlc plc;
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.vertices = {{4, 0, 0}, {-2, 3, 0}, {-2, -3, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const auto& [a, b] : {std::array{0u, 1u}, {1u, 2u}, {2u, 0u}}) {
    plc.triangles.push_back({a, b, 3});
    plc.triangles.push_back({b, a, 4});
  }
  return plc;
}

/// The same with the triangle as a facet.
plc::InputPlc divided_bipyramid() {
  plc::InputPlc plc = flat_bipyramid();
  plc.triangles.push_back({0, 1, 2});
  return plc;
}

TEST(Front, HasNothingToDoWhereAllFacesAreDelaunay) {
  const Stages cube(unit_cube());
  EXPECT_EQ(cube.undelaunay(), 0u);
  const front::FrontResult result = cube.advance();
  EXPECT_TRUE(result.tetrahedra.empty());
  EXPECT_EQ(result.open.size(), 12u);  // one side of each face
  EXPECT_EQ(result.undelaunay_faces, 0u);
}

TEST(Front, FillsATetrahedronWithItself) {
  plc::InputPlc input;
  input.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  input.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const front::FrontResult result = Stages(input).advance_all();
  EXPECT_EQ(sorted(result.tetrahedra), Cells({{0, 1, 2, 3}}));
  EXPECT_TRUE(result.open.empty());
}

TEST(Front, BuildsTheDelaunayCellsWhereNoFacetIsInTheWay) {
  const Stages bipyramid(flat_bipyramid());
  EXPECT_EQ(bipyramid.undelaunay(), 0u);
  EXPECT_TRUE(bipyramid.advance().tetrahedra.empty());
  EXPECT_EQ(sorted(bipyramid.advance_all().tetrahedra), Cells({{0, 1, 3, 4}, {0, 2, 3, 4}, {1, 2, 3, 4}}));
}

TEST(Front, KeepsAFacetThatADelaunayEdgePierces) {
  const Stages bipyramid(divided_bipyramid());
  EXPECT_EQ(bipyramid.undelaunay(), 1u);
  EXPECT_EQ(bipyramid.delaunay.vertices.size(), 5u);
  for (const front::FrontResult& result : {bipyramid.advance(), bipyramid.advance_all()}) {
    EXPECT_EQ(sorted(result.tetrahedra), Cells({{0, 1, 2, 3}, {0, 1, 2, 4}}));
    EXPECT_TRUE(result.open.empty());
    ASSERT_EQ(result.regions.size(), 2u);
    EXPECT_NE(result.regions[0], result.regions[1]);  // the facet divides the domain
  }
}

TEST(Front, KeepsAVertexWhoseDelaunayEdgesAllGoThroughFacets) {
  // In a thin plate between vertices outside it.
  plc::InputPlc plate = unit_cube();
  for (Point3& p : plate.vertices) p = {16 * p.x, 4 * p.y, (2 + 14 * p.z) / 1024};
  plate.vertices.insert(
      plate.vertices.end(),
      {{6.03125, 2.0078125, 0.0078125}, {6, 4.125, 0.375}, {2, 0.75, 0.25}, {9, 0.5, 0.25}, {16, 4, 0}});
  const Stages stages(plate);
  for (const locate::LocatorKind locator :
       {locate::LocatorKind::cavity, locate::LocatorKind::octree, locate::LocatorKind::grid}) {
    const Cells cells = sorted(stages.advance_all({locator}).tetrahedra);
    EXPECT_TRUE(std::ranges::any_of(cells, [](const auto& t) { return std::ranges::find(t, 8u) != t.end(); }));
  }
}

/// Section 5.3 of the paper: the faces of the PLC that are undelaunay, by their sides within the domain, and new ones.
TEST(Front, CountsTheUndelaunayFacesThatItMeets) {
  const Stages bipyramid(divided_bipyramid());
  EXPECT_EQ(bipyramid.advance().undelaunay_faces, 2u);      // both sides of the facet; all others are Delaunay
  EXPECT_EQ(bipyramid.advance_all().undelaunay_faces, 8u);  // nothing is checked: all are as if they were not
  const Stages bars(two_bars());
  EXPECT_GE(bars.advance().undelaunay_faces, bars.undelaunay());
}

TEST(Front, IsNotHinderedByTheWayTheInputTurns) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    plc::InputPlc input = rotated(random_rotation(random), divided_bipyramid());
    std::shuffle(input.triangles.begin(), input.triangles.end(), random);
    for (auto& t : input.triangles)
      if (random() % 2) std::swap(t[0], t[1]);
    EXPECT_EQ(sorted(Stages(input).advance().tetrahedra), Cells({{0, 1, 2, 3}, {0, 1, 2, 4}}));
  }
}

TEST(Front, StopsAtDelaunayFacesAndLeavesTheRest) {
  const Stages bars(two_bars());
  EXPECT_GT(bars.undelaunay(), 0u);
  const front::FrontResult result = bars.advance(), all = bars.advance_all();
  EXPECT_GT(result.tetrahedra.size(), 0u);
  EXPECT_LT(result.tetrahedra.size(), all.tetrahedra.size());
  EXPECT_GT(result.open.size(), 0u);
  EXPECT_TRUE(all.open.empty());
  const Cells built = sorted(result.tetrahedra), everything = sorted(all.tetrahedra);
  EXPECT_TRUE(std::includes(everything.begin(), everything.end(), built.begin(), built.end()));
}

TEST(Front, FillsTheWholeVolumeByItself) {
  for (const plc::InputPlc& input : {l_shape(), cube_with_cubic_hole(), two_bars(), cube_with_turnstile()}) {
    const Stages stages(input);
    double sixfold = 0;
    for (const auto& [a, b, c, d] : stages.advance_all().tetrahedra) {
      const Point3& origin = stages.delaunay.point(a);
      sixfold += dot(cross(stages.delaunay.point(b) - origin, stages.delaunay.point(c) - origin),
                     stages.delaunay.point(d) - origin);
    }
    const double unit = stages.plc.grid.unit;
    EXPECT_NEAR(sixfold / 6 * unit * unit * unit, inside_volume(stages.plc), 1e-9);
  }
}

/// Oblique plates on a beam, each of 1e-6 of its length, so that nearly all vertices near a face are behind other
/// plates.
plc::InputPlc stack_on_a_beam() {
  plc::InputPlc stack;
  const Point3 along{-41, 31, -38}, across{0.59375, 0.796875, 0}, up{-0.484375, 0.359375, 0.796875};
  for (const double height : {0.0, 0x1p-6, 0x1p-6 + 0x1p-17, 0x1p-6 + 0x1p-16, 0x1p-6 + 0x1p-15}) {
    const auto first = static_cast<std::uint32_t>(stack.vertices.size());
    for (const Point3& p : {Point3{0, 0, 0}, along, along + across, across}) stack.vertices.push_back(p + height * up);
    if (first > 0)
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        stack.polygon_facets.push_back({{{first - 4 + k, first - 4 + next, first + next, first + k}}, {}, 0, 0});
      }
    stack.polygon_facets.push_back({{{first, first + 1, first + 2, first + 3}}, {}, 0, 0});
  }
  return stack;
}

TEST(Front, LooksAtFewFacesInAStackOfThinPlates) {
  MeshOptions options;
  options.lattice = Lattice::none;
  options.surface = SurfaceRule::refine;
  const MeshResult result = mesh_plc(stack_on_a_beam(), options);
  EXPECT_GT(result.counts.front_tetrahedra, 500u);
  EXPECT_LT(result.costs[Stage::front].work.visibility_tests, 25 * result.counts.front_tetrahedra);
}

}  // namespace
}  // namespace ccdt
