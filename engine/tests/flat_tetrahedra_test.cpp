#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "engine/base/errors.h"
#include "engine/tests/mesh_checks.h"
#include "engine/tests/mesh_test_solids.h"

// Tetrahedra of almost no volume, with all vertices on a facet that is flat only within the tolerance.

namespace ccdt {
namespace {

using namespace mesh_test;

/// A tetrahedron over the narrow triangle 0 1 2, whose face there has another vertex, 4, beside the middle of the short
/// edge 0 1 and above the plane, by so little that the two triangles at it are one facet. A third triangle, a facet of
/// its own, closes the gap to the edge.
InputPlc tetrahedron_with_a_closed_gap() {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1e-4, 0, 0}, {5e-5, 4, 0}, {5e-5, 1, -4}, {5e-5, 0, 1e-8}};
  plc.triangles = {{2, 0, 4}, {2, 4, 1}, {0, 1, 4}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  plc.triangle_markers = {1, 1, 2, 3, 4, 5};
  return plc;
}

TEST(FlatTetrahedra, WithAFaceOnAnotherFacetAreNotRemoved) {
  const InputPlc input = tetrahedron_with_a_closed_gap();
  MeshOptions options;
  options.lattice = Lattice::none;
  const MeshResult result = mesh_plc(input, options);
  EXPECT_EQ(result.mesh.tetrahedra.size(), 2u);
  expect_verified(input, result.mesh);
}

/// A plate whose vertices are moved by up to a third of its height.
InputPlc rough_plate(double height, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-height / 3, height / 3);
  std::map<std::array<double, 3>, Point3> moved;
  return mapped(gridded_plate(2, height), [&](const Point3& p) {
    const auto found = moved.find(as_array(p));
    if (found != moved.end()) return found->second;
    return moved[as_array(p)] = p + Point3{part(random), part(random), part(random)};
  });
}

// Both sides of the plate may get the same triangle, which the front then has twice.
TEST(FlatTetrahedra, OfAPlateThinnerThanTheToleranceDoNotConfuseTheFront) {
  std::mt19937 random(1);
  MeshOptions options;
  options.lattice = Lattice::none;
  options.flatness = 2e-6;
  int meshed = 0;
  for (int i = 0; i < 20; ++i) {
    try {
      meshed += !mesh_plc(rough_plate(3e-8, random), options).mesh.tetrahedra.empty();
    } catch (const ccdt::Error& error) {
      EXPECT_FALSE(error.place().points.empty());
    }
  }
  EXPECT_GT(meshed, 0);
}

}  // namespace
}  // namespace ccdt
