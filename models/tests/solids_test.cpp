#include "models/solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "models/tests/surface_checks.h"

namespace ccdt::testing {
namespace {

struct SizedSolid {
  std::string_view name;
  double edge_length;
  long euler;
};

void PrintTo(const SizedSolid& c, std::ostream* out) {
  *out << c.name << " at " << c.edge_length;
}

class SolidMesh : public ::testing::TestWithParam<SizedSolid> {
 protected:
  plc::InputPlc input = models::make_solid(GetParam().name, GetParam().edge_length);
};

TEST_P(SolidMesh, BoundaryIsClosedAndOrientedOutwards) {
  const Triangles boundary = boundary_triangles(input);
  for (const EdgeUse& edge : edges_of(boundary)) {
    ASSERT_EQ(edge.forwards, 1);
    ASSERT_EQ(edge.backwards, 1);
  }
  EXPECT_GT(enclosed_volume(input.vertices, boundary), 0);
}

TEST_P(SolidMesh, BoundaryHasTheGenusOfTheSolid) {
  EXPECT_EQ(euler_characteristic(boundary_triangles(input)), GetParam().euler);
}

TEST_P(SolidMesh, EveryVertexIsUsedAndDifferent) {
  std::set<std::array<double, 3>> places;
  for (const Point3& p : input.vertices) EXPECT_TRUE(places.insert(as_array(p)).second);
  std::set<std::uint32_t> used;
  for (const auto& t : input.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), input.vertices.size());
}

TEST_P(SolidMesh, MarkersCountUpFromOneWithoutAGap) {
  ASSERT_EQ(input.triangle_markers.size(), input.triangles.size());
  const std::set<int> markers(input.triangle_markers.begin(), input.triangle_markers.end());
  EXPECT_EQ(*markers.begin(), 1);
  EXPECT_EQ(*markers.rbegin(), static_cast<int>(markers.size()));
}

TEST_P(SolidMesh, IsTheSameEachTime) {
  const plc::InputPlc again = models::make_solid(GetParam().name, GetParam().edge_length);
  EXPECT_EQ(input.vertices, again.vertices);
  EXPECT_EQ(input.triangles, again.triangles);
  EXPECT_EQ(input.triangle_markers, again.triangle_markers);
}

TEST_P(SolidMesh, NoAngleIsVerySmall) {
  const std::vector<double> angles = smallest_angles(input);
  EXPECT_GT(quantile(angles, 0), 23);
  EXPECT_GT(quantile(angles, 0.02), 26);
  EXPECT_GT(quantile(angles, 0.5), 30);
}

INSTANTIATE_TEST_SUITE_P(
    Solids, SolidMesh,
    ::testing::Values(SizedSolid{"piston", 16, -2}, SizedSolid{"piston", 12, -2}, SizedSolid{"piston", 4, -2},
                      SizedSolid{"piston", 1.5, -2}, SizedSolid{"bracket", 16, -6}, SizedSolid{"bracket", 12, -6},
                      SizedSolid{"bracket", 4, -6}, SizedSolid{"bracket", 1.5, -6}, SizedSolid{"stepping-pole", 12, 2},
                      SizedSolid{"stepping-pole", 6, 2}, SizedSolid{"stepping-pole", 3, 2},
                      SizedSolid{"stepping-pole", 1, 2}, SizedSolid{"cube", 1, 2}, SizedSolid{"cube", 0.3, 2},
                      SizedSolid{"cube", 1.0 / 60, 2}, SizedSolid{"sphere", 1.2, 2}, SizedSolid{"sphere", 0.3, 2},
                      SizedSolid{"sphere", 0.03, 2}, SizedSolid{"torus", 0.5, 0}, SizedSolid{"torus", 0.2, 0},
                      SizedSolid{"torus", 0.03, 0}, SizedSolid{"schoenhardt", 0, 2}));

// Where the edge length resolves the features, the mesh is that of a good surface mesher.
class ResolvedSolid : public SolidMesh {};

TEST_P(ResolvedSolid, TrianglesAreWellShaped) {
  const std::vector<double> angles = smallest_angles(input);
  EXPECT_GT(quantile(angles, 0), 25);
  EXPECT_GT(quantile(angles, 0.001), 29);
  EXPECT_GT(quantile(angles, 0.02), 36);
  EXPECT_GT(quantile(angles, 0.5), 43);
}

TEST_P(ResolvedSolid, EdgesAreOfEvenLength) {
  const double edge_length = GetParam().edge_length;
  const std::vector<double> lengths = edge_lengths(input);
  EXPECT_GT(quantile(lengths, 0), 0.5 * edge_length);
  EXPECT_GT(quantile(lengths, 0.01), 0.6 * edge_length);
  EXPECT_NEAR(quantile(lengths, 0.5), edge_length, 0.12 * edge_length);
  EXPECT_LT(quantile(lengths, 0.99), 1.6 * edge_length);
  EXPECT_LT(quantile(lengths, 1), 1.9 * edge_length);
}

INSTANTIATE_TEST_SUITE_P(Solids, ResolvedSolid,
                         ::testing::Values(SizedSolid{"piston", 4, -2}, SizedSolid{"piston", 2, -2},
                                           SizedSolid{"piston", 1, -2}, SizedSolid{"bracket", 4, -6},
                                           SizedSolid{"bracket", 2, -6}, SizedSolid{"bracket", 1, -6},
                                           SizedSolid{"stepping-pole", 3, 2}, SizedSolid{"stepping-pole", 1.5, 2},
                                           SizedSolid{"stepping-pole", 0.6, 2}, SizedSolid{"cube", 0.1, 2},
                                           SizedSolid{"cube", 0.02, 2}, SizedSolid{"sphere", 0.3, 2},
                                           SizedSolid{"sphere", 0.02, 2}, SizedSolid{"torus", 0.2, 0},
                                           SizedSolid{"torus", 0.02, 0}));

TEST(Solids, RangeFromHundredsToTwoHundredThousandVertices) {
  for (const auto& [name, finest] : {std::pair{"piston", 0.52}, {"bracket", 0.36}, {"stepping-pole", 0.34}}) {
    EXPECT_LT(models::make_solid(name, 12).vertices.size(), 1200u) << name;
    const plc::InputPlc fine = models::make_solid(name, finest);
    EXPECT_GT(fine.vertices.size(), 190000u) << name;
    EXPECT_LT(fine.vertices.size(), 220000u) << name;
    EXPECT_GT(quantile(smallest_angles(fine), 0), 24) << name;
    for (const EdgeUse& edge : edges_of(boundary_triangles(fine))) {
      ASSERT_EQ(edge.forwards, 1) << name;
      ASSERT_EQ(edge.backwards, 1) << name;
    }
  }
}

TEST(Solids, CurvedPatchesAreFollowed) {
  const plc::InputPlc sphere = models::make_solid("sphere", 0.1), torus = models::make_solid("torus", 0.1),
                      piston = models::make_solid("piston", 3);
  for (const Point3& p : sphere.vertices) EXPECT_NEAR(squared_length(p), 1, 1e-14);
  for (const Point3& p : torus.vertices) EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - 1, p.z), 0.4, 1e-14);
  for (const auto& t : triangles_with_marker(piston, 5)) {
    for (const std::uint32_t v : t) EXPECT_NEAR(std::hypot(piston.vertices[v].x, piston.vertices[v].y), 40, 1e-12);
  }
  for (const auto& t : triangles_with_marker(piston, 8)) {
    for (const std::uint32_t v : t) EXPECT_NEAR(std::hypot(piston.vertices[v].y, piston.vertices[v].z - 22), 9, 1e-12);
  }
}

TEST(Solids, PlaneFacesAlongTheAxesAreExactlyPlane) {
  const plc::InputPlc piston = models::make_solid("piston", 3), bracket = models::make_solid("bracket", 3);
  const auto expect_coordinate = [](const plc::InputPlc& input, int marker, std::size_t axis, std::set<double> values) {
    for (const auto& t : triangles_with_marker(input, marker)) {
      for (const std::uint32_t v : t) EXPECT_TRUE(values.contains(as_array(input.vertices[v])[axis])) << marker;
    }
  };
  expect_coordinate(piston, 1, 2, {70});
  expect_coordinate(piston, 6, 2, {0});
  expect_coordinate(bracket, 1, 2, {0, 8});
  expect_coordinate(bracket, 2, 0, {0, 8});
  expect_coordinate(bracket, interior_face_marker, 0, {16});
  expect_coordinate(bracket, slit_marker, 1, {30});
}

TEST(Bracket, InteriorFaceMeetsTheBoundaryInItsEdgesAllAround) {
  const plc::InputPlc bracket = models::make_solid("bracket", 3);
  std::set<std::array<std::uint32_t, 2>> boundary_edges;
  for (const EdgeUse& edge : edges_of(boundary_triangles(bracket))) boundary_edges.insert(edge.ends);
  std::size_t rim = 0;
  for (const EdgeUse& edge : edges_of(triangles_with_marker(bracket, interior_face_marker))) {
    const bool is_rim = edge.forwards + edge.backwards == 1;
    EXPECT_EQ(boundary_edges.contains(edge.ends), is_rim);
    rim += is_rim;
  }
  EXPECT_GT(rim, 20u);
}

TEST(Bracket, SlitBeginsAtTheBoundaryAndEndsInside) {
  const plc::InputPlc bracket = models::make_solid("bracket", 3);
  std::set<std::array<std::uint32_t, 2>> boundary_edges;
  for (const EdgeUse& edge : edges_of(boundary_triangles(bracket))) boundary_edges.insert(edge.ends);
  std::size_t on_boundary = 0, inside = 0;
  for (const EdgeUse& edge : edges_of(triangles_with_marker(bracket, slit_marker))) {
    if (edge.forwards + edge.backwards == 2) continue;
    if (boundary_edges.contains(edge.ends)) {
      ++on_boundary;
    } else {
      ++inside;
      for (const std::uint32_t v : edge.ends) EXPECT_EQ(bracket.vertices[v].x, 62);
    }
  }
  EXPECT_GT(on_boundary, 10u);
  EXPECT_GT(inside, 1u);
}

TEST(Bracket, EachRegionHasItsSeedInsideOnItsSideOfTheInteriorFace) {
  const plc::InputPlc bracket = models::make_solid("bracket", 6);
  EXPECT_EQ(bracket.inside, plc::InputPlc::Inside::seeds);
  ASSERT_EQ(bracket.regions.size(), 2u);
  EXPECT_NE(bracket.regions[0].attribute, bracket.regions[1].attribute);
  EXPECT_GT(bracket.regions[0].seed.x, 16);
  EXPECT_LT(bracket.regions[1].seed.x, 16);
  for (const plc::InputPlc::RegionSeed& region : bracket.regions) {
    EXPECT_NEAR(winding_number(bracket.vertices, boundary_triangles(bracket), region.seed), 1, 1e-9);
  }
}

TEST(Schoenhardt, HasSixVerticesAndEightTrianglesAtEveryEdgeLength) {
  for (const double edge_length : {0.0, 1.0, 0.01}) {
    const plc::InputPlc input = models::make_solid("schoenhardt", edge_length);
    EXPECT_EQ(input.vertices.size(), 6u);
    EXPECT_EQ(input.triangles.size(), 8u);
  }
}

TEST(Solids, HaveADefaultEdgeLengthWithinTheirLimits) {
  ASSERT_EQ(models::solids().size(), 9u);
  for (const models::Solid& solid : models::solids()) {
    const plc::InputPlc by_default = models::make_solid(solid.name, 0);
    EXPECT_EQ(by_default.name, solid.name);
    EXPECT_EQ(by_default.vertices, models::make_solid(solid.name, solid.default_edge_length).vertices);
  }
}

TEST(Solids, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    models::make_solid("wheel", 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.remedy().find("stepping-pole"), std::string::npos);
  }
}

TEST(Solids, AnEdgeLengthWithoutSenseIsRefused) {
  for (const std::string_view name :
       {"piston", "bracket", "stepping-pole", "cube", "graded-cube", "sphere", "rough-sphere", "torus"}) {
    EXPECT_THROW(models::make_solid(name, 1000), InputError) << name;
    EXPECT_THROW(models::make_solid(name, 1e-9), InputError) << name;
    EXPECT_THROW(models::make_solid(name, std::numeric_limits<double>::infinity()), InputError) << name;
    EXPECT_THROW(models::make_solid(name, std::numeric_limits<double>::quiet_NaN()), InputError) << name;
  }
}

}  // namespace
}  // namespace ccdt::testing
