#include "bench/experiments/surfaces.h"

#include <gtest/gtest.h>

#include "baselines/tests/shapes.h"
#include "engine/plc/build_plc.h"
#include "models/solids.h"

namespace ccdt {
namespace {

/// A prism of length 1 over a triangle with the corners (0,0), (1,0) and (1,height): its smallest dihedral angle is
/// at the axis x = y = 0.
InputPlc wedge(double height) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {1, height, 0}, {0, 0, 1}, {1, 0, 1}, {1, height, 1}};
  plc.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  return plc;
}

TEST(SurfaceMeasures, FindTheSharpestEdgeOfAWedge) {
  const Plc plc = build_plc(wedge(0.2));
  const SurfaceAngles angles = smallest_angles(plc);
  EXPECT_NEAR(angles.dihedral.degrees, 11.3099325, 1e-6);  // atan(0.2)
  EXPECT_NEAR(angles.dihedral.at.x, 0, 1e-12);
  EXPECT_NEAR(angles.dihedral.at.y, 0, 1e-12);
  EXPECT_LE(angles.planar.degrees, 11.3099325 + 1e-6);
  EXPECT_NEAR(enclosed_volume(plc), 0.1, 1e-12);
}

TEST(SurfaceMeasures, DoNotDependOnHowTrianglesAreOriented) {
  InputPlc turned = wedge(0.2);
  for (const std::size_t t : {0u, 3u, 6u}) std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  const Plc plc = build_plc(turned);
  EXPECT_NEAR(smallest_angles(plc).dihedral.degrees, 11.3099325, 1e-6);
  EXPECT_NEAR(enclosed_volume(plc), 0.1, 1e-12);
}

TEST(SurfaceMeasures, MeasureAnglesInsideTheDomainAlone) {
  // A cube in which a wedge is missing: the sharp edge is outside, the domain has 360 - 11.3 degrees there.
  InputPlc plc = wedge(0.2);
  shapes::add_cube(plc, -3, 3);
  const Plc built = build_plc(plc);
  EXPECT_NEAR(smallest_angles(built).dihedral.degrees, 90, 1e-6);
  EXPECT_NEAR(enclosed_volume(built), 216 - 0.1, 1e-9);
}

TEST(SurfaceMeasures, KnowAFacetBetweenTwoRegionsAndASlit) {
  const Plc bracket = build_plc(make_solid("bracket", 0));
  const SurfaceAngles angles = smallest_angles(bracket);
  EXPECT_GT(angles.dihedral.degrees, 30);
  EXPECT_LE(angles.dihedral.degrees, 90 + 1e-6);
  EXPECT_GT(enclosed_volume(bracket), 0);
}

TEST(SurfaceMeasures, CallEvenWhatHasGoodTrianglesOfTheWantedSize) {
  const Plc cube = build_plc(make_solid("cube", 0.25));
  EXPECT_TRUE(has_even_triangles(cube, 0.25));
  EXPECT_FALSE(has_even_triangles(cube, 0.5));
  EXPECT_FALSE(has_even_triangles(build_plc(wedge(0.2)), 1));
  EXPECT_FALSE(has_even_triangles(build_plc(make_solid("graded-cube", 0.125)), 0.125));
}

}  // namespace
}  // namespace ccdt
