#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

// after GoogleTest, whose macros it uses
#include "engine/geometry/surface_distance.h"
#include "engine/mesher.h"
#include "engine/plc/build_plc.h"
#include "engine/surface/remesh_surface.h"
#include "engine/surface/surface_change.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/surface/remesh_measures.h"

// Remeshing within a distance from the old surface.

namespace ccdt {
namespace {

using mesh_test::double_cone;
using surface::measure_change;
using surface::remesh_surface;

/// A column over a lens, with a roof of two facets. Their ridge from tip to tip is not sharp, and meets the walls at
/// angles of 17 degrees.
InputPlc lens_with_ridge() {
  InputPlc plc;
  plc.vertices = {{-1, 0, 0}, {0, -0.3, 0},    {1, 0, 0}, {0, 0.3, 0},
                  {-1, 0, 1}, {0, -0.3, 0.98}, {1, 0, 1}, {0, 0.3, 0.98}};
  plc.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    plc.triangles.push_back({i, next, next + 4});
    plc.triangles.push_back({i, next + 4, i + 4});
  }
  return plc;
}

TEST(Deviation, ABendIsKeptBetweenBothOfItsNarrowEnds) {
  constexpr double deviation = 0.002;
  const InputPlc before = lens_with_ridge(),
                 after = remesh_surface(before, {.edge_length = 0.2, .deviation = deviation});
  EXPECT_LE(measure_change(before, after, deviation).distance, deviation);
  std::vector<TrianglePoints> triangles;
  for (const auto& [a, b, c] : after.triangles)
    triangles.push_back({after.vertices[a], after.vertices[b], after.vertices[c]});
  const NearestTriangle surface(triangles);
  for (const double x : {-0.9, -0.5, 0.0, 0.5, 0.9}) EXPECT_LT(surface.nearest({x, 0, 1}).squared_distance, 1e-20) << x;
}

TEST(Deviation, IsKeptByTipsOfManyNeedles) {
  for (const int sides : {12, 48, 200})
    for (const double deviation : {1e-2, 1e-3}) {
      SCOPED_TRACE(std::to_string(sides) + " sides, " + std::to_string(deviation));
      const InputPlc before = double_cone(sides, 1.5, 1.5),
                     after = remesh_surface(before, {.edge_length = 0.2, .deviation = deviation});
      EXPECT_LE(measure_change(before, after, deviation).distance, deviation);
      EXPECT_GE(remesh_test::smallest_angle_of_99_percent(after), 20);
      EXPECT_NO_THROW(plc::build_plc(after));
    }
}

TEST(Deviation, IsABoundEvenIfItIsTiny) {
  const InputPlc before = double_cone(24, 1.5, 1.5),
                 after = remesh_surface(before, {.edge_length = 0.4, .deviation = 1e-8});
  EXPECT_LE(measure_change(before, after, 1e-8).distance, 1e-8);
}

}  // namespace
}  // namespace ccdt
