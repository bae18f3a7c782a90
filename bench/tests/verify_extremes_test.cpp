#include <gtest/gtest.h>

#include <cmath>

#include "bench/tests/verify_cases.h"
#include "engine/base/errors.h"
#include "engine/mesher.h"
#include "engine/repair/find_faults.h"

// Inputs at the limits of what has a meaning: mesh, check and verify mean the same.

namespace ccdt {
namespace {

/// A tetrahedron at the origin with three edges of this length along the axes.
InputPlc corner_of(double side) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0, 0, side}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return plc;
}

void expect_right(const InputPlc& input, const MeshOptions& options = {}) {
  const verify::Verification verification = verify::verify(input, mesh_plc(input, options).mesh);
  EXPECT_TRUE(verification.ok()) << all_lines(verification);
}

TEST(VerifyExtremes, SizesWithinTheLimitsAreAllAlike) {
  for (const double side : {1.01e-100, 1e-90, 1e-60, 1e-20, 1e20, 1e60, 1e80, 0.99e100}) {
    const InputPlc input = corner_of(side);
    const verify::Verification verification = verify::verify(input, mesh_plc(input, {}).mesh);
    EXPECT_TRUE(verification.ok()) << side << "\n" << all_lines(verification);
    const double volume = side * side * side / 6;
    EXPECT_NEAR(verification.input_volume / volume, 1, 1e-12) << side;
    EXPECT_NEAR(verification.mesh_volume / volume, 1, 1e-12) << side;
    EXPECT_TRUE(repair::find_faults(input, usual_flatness).is_valid()) << side;
  }
}

TEST(VerifyExtremes, OtherSizesAreRefusedByAll) {
  const mesh::TetMesh mesh = mesh_plc(corner_of(1), {}).mesh;
  for (const double side : {0.99e-100, 1e-108, 1e-200, 1.01e100, 1e150}) {
    const InputPlc input = corner_of(side);
    EXPECT_THROW(mesh_plc(input, {}), InputError) << side;
    EXPECT_THROW(verify::verify(input, mesh), InputError) << side;
    const repair::Diagnosis diagnosis = repair::find_faults(input, usual_flatness);
    ASSERT_EQ(diagnosis.faults.size(), 1u) << side;
    EXPECT_EQ(diagnosis.faults[0].kind, repair::FaultKind::extent) << side;
    EXPECT_FALSE(diagnosis.is_valid());
  }
}

/// A plate with a square hole. Its top and bottom are one polygon each, which runs around the hole by a bridge.
InputPlc plate_with_bridges() {
  InputPlc plc;
  for (const double z : {0.0, 1.0})
    for (const auto& [low, high] : {std::pair{0.0, 4.0}, std::pair{1.0, 3.0}})
      plc.vertices.insert(plc.vertices.end(), {{low, low, z}, {high, low, z}, {high, high, z}, {low, high, z}});
  const auto facet = [&](std::vector<std::uint32_t> corners) {
    PolygonFacet polygon;
    polygon.number = static_cast<std::uint32_t>(plc.polygon_facets.size());
    polygon.polygons = {std::move(corners)};
    plc.polygon_facets.push_back(polygon);
  };
  facet({0, 3, 2, 1, 0, 4, 5, 6, 7, 4});
  facet({8, 9, 10, 11, 8, 12, 15, 14, 13, 12});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    facet({i, next, 8 + next, 8 + i});
    facet({4 + next, 4 + i, 12 + i, 12 + next});
  }
  return plc;
}

TEST(VerifyExtremes, AnOutlineThatRunsAroundAHoleByABridgeHasTheHole) {
  const InputPlc input = plate_with_bridges();
  const repair::Diagnosis diagnosis = repair::find_faults(input, usual_flatness);
  EXPECT_TRUE(diagnosis.is_valid());
  EXPECT_EQ(diagnosis.regions, 1u);
  EXPECT_DOUBLE_EQ(diagnosis.volume, 12);
  const MeshResult result = mesh_plc(input, {});
  const verify::Verification verification = verify::verify(input, result.mesh);
  EXPECT_TRUE(verification.ok()) << all_lines(verification);
  EXPECT_NEAR(verification.input_volume, 12, 1e-12);
  EXPECT_NEAR(verification.mesh_volume, 12, 1e-12);
}

TEST(VerifyExtremes, APolygonOfAComplexThatDrawsALoopIsFilled) {
  InputPlc input = plate_with_bridges();
  input.inside = InputPlc::Inside::seeds;
  const verify::Verification verification = verify::verify(input, mesh_plc(input, {}).mesh);
  EXPECT_TRUE(verification.ok()) << all_lines(verification);
  EXPECT_NEAR(verification.input_volume, 16, 1e-12);
}

TEST(VerifyExtremes, ASmallPartFarFromTheOriginMayBeRefined) {
  const auto place = [](const Point3& p) { return Point3{441871.5, 6329700.7, -1200.1} + 0.1 * rotated(p); };
  MeshOptions options;
  options.surface = SurfaceRule::refine;
  expect_right(make_grid_mesh({2, 2, 2}, everywhere, false, place).input, options);
}

TEST(VerifyExtremes, VerticesOutsideThatAreHardlyApartAreOne) {
  InputPlc input = corner_of(1);
  input.inside = InputPlc::Inside::even_odd;
  input.vertices.insert(input.vertices.end(), {{-1 + 3e-16, -1, -1}, {-1, -1, -1}, {-1, -1, -1}, {-0.5, -0.6, -0.7}});
  input.triangles.push_back({7, 4, 5});
  input.triangles.push_back({7, 6, 4});
  expect_right(input);
}

TEST(VerifyExtremes, EdgesAndFacetsOutsideTheDomainAreNotListed) {
  InputPlc input = corner_of(1);
  input.inside = InputPlc::Inside::seeds;
  input.vertices.insert(input.vertices.end(), {{3, 3, 3}, {4, 3, 3}, {3, 4, 3}});
  input.triangles.push_back({4, 5, 6});
  input.segments = {{1, 4}};
  const mesh::TetMesh mesh = mesh_plc(input, {}).mesh;
  for (const auto& [a, b] : mesh.edges) EXPECT_TRUE(a < 4 && b < 4) << a << " " << b;
  EXPECT_EQ(mesh.edges.size(), 6u);
  EXPECT_EQ(mesh.faces.size(), 4u);
  expect_right(input);
}

}  // namespace
}  // namespace ccdt
