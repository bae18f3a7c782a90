#include "bench/run/surface_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "baselines/tests/shapes.h"
#include "engine/plc/build_plc.h"
#include "models/solids.h"

namespace ccdt {
namespace {

/// A prism of length 1 over a triangle with the corners (0,0), (1,0) and (1,height): its smallest dihedral angle is
/// at the axis x = y = 0.
plc::InputPlc wedge(double height) {
  plc::InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {1, height, 0}, {0, 0, 1}, {1, 0, 1}, {1, height, 1}};
  plc.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return plc;
}

TEST(SurfaceMeasures, FindTheSharpestEdgeOfAWedge) {
  const plc::Plc plc = plc::build_plc(wedge(0.2));
  const bench::SurfaceAngles angles = bench::smallest_angles(plc);
  EXPECT_NEAR(angles.dihedral.degrees, 11.3099325, 1e-6);  // atan(0.2)
  EXPECT_NEAR(angles.dihedral.at.x, 0, 1e-12);
  EXPECT_NEAR(angles.dihedral.at.y, 0, 1e-12);
  EXPECT_LE(angles.planar.degrees, 11.3099325 + 1e-6);
  EXPECT_NEAR(bench::enclosed_volume(plc), 0.1, 1e-12);
}

TEST(SurfaceMeasures, DoNotDependOnHowTrianglesAreOriented) {
  plc::InputPlc turned = wedge(0.2);
  for (const std::size_t t : {0u, 3u, 6u}) std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  const plc::Plc plc = plc::build_plc(turned);
  EXPECT_NEAR(bench::smallest_angles(plc).dihedral.degrees, 11.3099325, 1e-6);
  EXPECT_NEAR(bench::enclosed_volume(plc), 0.1, 1e-12);
}

TEST(SurfaceMeasures, MeasureAnglesInsideTheDomainAlone) {
  // A cube in which a wedge is missing: the sharp edge is outside, the domain has 360 - 11.3 degrees there.
  plc::InputPlc plc = wedge(0.2);
  shapes::add_cube(plc, -3, 3);
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_NEAR(bench::smallest_angles(built).dihedral.degrees, 90, 1e-6);
  EXPECT_NEAR(bench::enclosed_volume(built), 216 - 0.1, 1e-9);
}

TEST(SurfaceMeasures, KnowAFacetBetweenTwoRegionsAndASlit) {
  const plc::Plc bracket = plc::build_plc(models::make_solid("bracket", 0));
  const bench::SurfaceAngles angles = bench::smallest_angles(bracket);
  EXPECT_GT(angles.dihedral.degrees, 30);
  EXPECT_LE(angles.dihedral.degrees, 90 + 1e-6);
  EXPECT_GT(bench::enclosed_volume(bracket), 0);
}

TEST(SurfaceMeasures, CallEvenWhatHasGoodTrianglesOfTheWantedSize) {
  const plc::Plc cube = plc::build_plc(models::make_solid("cube", 0.25));
  EXPECT_TRUE(bench::has_even_triangles(cube, 0.25));
  EXPECT_FALSE(bench::has_even_triangles(cube, 0.5));
  EXPECT_FALSE(bench::has_even_triangles(plc::build_plc(wedge(0.2)), 1));
  EXPECT_FALSE(bench::has_even_triangles(plc::build_plc(models::make_solid("graded-cube", 0.125)), 0.125));
}

TEST(SurfaceMeasures, TakeTheEdgeRatioOfTrianglesPolygonsAndSegments) {
  plc::InputPlc plc;
  EXPECT_EQ(bench::edge_ratio(plc), 1);
  plc.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {10, 0, 0}, {10, 1, 0}};
  plc.triangles = {{0, 1, 2}};
  EXPECT_DOUBLE_EQ(bench::edge_ratio(plc), 5.0 / 3);
  plc.polygon_facets.push_back({{{1, 3, 2}}, {}, 0, 0});
  EXPECT_DOUBLE_EQ(bench::edge_ratio(plc), std::sqrt(116.0) / 3);
  plc.segments = {{3, 4}};
  EXPECT_DOUBLE_EQ(bench::edge_ratio(plc), std::sqrt(116.0));
}

TEST(SurfaceMeasures, FindTheSmallestAngleOfSegmentsThatMeet) {
  plc::InputPlc tetrahedron;
  tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(tetrahedron, {})), 45, 1e-9);
}

}  // namespace
}  // namespace ccdt
