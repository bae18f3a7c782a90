#include <gtest/gtest.h>

#include "engine/io/plc_files.h"
#include "engine/tests/mesh_checks.h"
#include "engine/tests/mesh_test_solids.h"
#include "engine/tests/real_parts.h"
#include "models/solids.h"

// The constrained Delaunay tetrahedralization is unique, so every strategy has to find the very same tetrahedra; and
// what they find is verified by other means than the engine's.

namespace ccdt {
namespace {

using namespace mesh_test;

TEST(Agreement, SmallInputs) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_agreement_of_all_strategies(plc);
  }
}

TEST(Agreement, SmallInputsRotated) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_agreement_of_all_strategies(rotated(oblique, plc));
  }
}

TEST(Agreement, SmallInputsAreConstrainedDelaunayByBruteForce) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    for (const Lattice lattice : {Lattice::none, Lattice::fcc}) {
      MeshOptions options;
      options.lattice = lattice;
      options.edge_length = 1;
      options.improve.improvement = Improvement::none;
      expect_constrained_delaunay(mesh_plc(plc, options).mesh, 1);
    }
  }
}

TEST(Agreement, ModelsAtThreeDensities) {
  for (const char* name : {"piston", "bracket", "stepping-pole"})
    for (const double edge_length : {5.0, 7.0, 11.0}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(edge_length));
      const InputPlc plc = models::make_solid(name, edge_length);
      for (const Lattice lattice : {Lattice::none, Lattice::fcc, Lattice::bcc, Lattice::sc})
        expect_agreement(plc, lattice);
    }
}

TEST(Agreement, ModelsRotated) {
  for (const char* name : {"piston", "bracket", "stepping-pole"}) {
    SCOPED_TRACE(name);
    const InputPlc plc = rotated(oblique, models::make_solid(name, 11));
    expect_agreement(plc, Lattice::none);
    expect_agreement(plc, Lattice::fcc);
  }
}

TEST(Agreement, PrimitivesPlainAndRotated) {
  for (const auto& [name, edge_length] : {std::pair{"cube", 0.2}, {"sphere", 0.25}, {"torus", 0.25}}) {
    SCOPED_TRACE(name);
    const InputPlc plc = models::make_solid(name, edge_length);
    expect_agreement_of_all_strategies(plc);
    expect_agreement_of_all_strategies(rotated(oblique, plc));
  }
}

TEST(Agreement, CosphericalPrismsAndAntiprisms) {
  for (const std::uint32_t corners : {3, 4, 5, 6, 8, 12, 32}) {
    SCOPED_TRACE(corners);
    for (const double turn : {0.0, -0.25, -0.5}) {
      const InputPlc plc = twisted_prism(corners, turn);
      expect_agreement(plc, Lattice::none);
      expect_agreement(rotated(oblique, plc), Lattice::none);
    }
  }
}

TEST(Agreement, RandomVoxelsPlainRotatedAndInPerspective) {
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const int n = 2 + i % 3;
    const InputPlc plc = random_voxels(n, 2 + i % 2, random);
    const Matrix turn = random_rotation(random);
    expect_agreement(plc, Lattice::none);
    expect_agreement(rotated(turn, plc), Lattice::none);
    expect_agreement(in_perspective(plc, n), Lattice::none);
    expect_agreement(rotated(turn, in_perspective(plc, n)), Lattice::none);
  }
}

TEST(Agreement, RandomVoxelsAreConstrainedDelaunayByBruteForce) {
  std::mt19937 random(2);
  MeshOptions options;
  options.lattice = Lattice::none;
  for (unsigned i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    expect_constrained_delaunay(mesh_plc(random_voxels(2, 2 + i % 2, random), options).mesh, i);
  }
}

TEST(Agreement, RandomConvexAndRandomRoughSurfaces) {
  std::mt19937 random(3);
  for (std::uint32_t i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    expect_agreement(random_convex(6 + i, random), Lattice::none);
    const InputPlc rough = roughened(models::make_solid("sphere", i % 3 == 0 ? 0.35 : 0.7), i % 2 ? 0.6 : 0.2, random);
    expect_agreement(rough, Lattice::none);
    expect_agreement(rough, Lattice::bcc);
  }
}

TEST(Agreement, RandomlyTwistedPrisms) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> turn(-0.95, 0.3), height(0.05, 3);
  for (std::uint32_t i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const double t = turn(random), h = height(random);
    expect_agreement(rotated(random_rotation(random), twisted_prism(3 + i % 6, t, h)), Lattice::none);
  }
}

TEST(Agreement, ThinPlates) {
  for (const double height : {0.1, 0.01, 0.001}) {
    SCOPED_TRACE(height);
    expect_agreement_of_all_strategies(gridded_plate(5, height));
    expect_agreement_of_all_strategies(rotated(oblique, gridded_plate(5, height)));
  }
}

TEST(Agreement, ADiaphragmThatIsFlatOnlyWithinTheTolerance) {
  InputPlc plc;
  plc.inside = InputPlc::Inside::seeds;
  plc.vertices = {
      {12.999999993175, 7.99999995084375, 8.000000038025}, {8.00000000934375, 12.99999999293125, 8.000000067925},
      {2.9999999462125, 7.9999999826125, 7.9999999891125}, {7.99999999699375, 3.00000000755625, 8.0000000060125},
      {7.9999999584, 7.9999999211875, 8.4999999715625},    {7.99999991899375, 7.9999999325625, 7.9921874881375}};
  for (std::uint32_t k = 0; k < 4; ++k)
    for (const std::uint32_t apex : {4, 5}) plc.triangles.push_back({k, (k + 1) % 4, apex});
  plc.polygon_facets.push_back({{{0, 1, 2, 3}}, {}, 3, 8});
  expect_agreement(plc, Lattice::none);
}

TEST(Agreement, SmallRealParts) {
  if (!there_are_parts()) GTEST_SKIP() << "no parts here; CCDT_PARTS names their folder";
  for (const char* name : {"joint.off", "anchor.off", "rotor.off", "pinion.off", "handle.off", "cube-meshed.off"}) {
    SCOPED_TRACE(name);
    const InputPlc plc = io::read_plc(folder_of_parts() / name);
    expect_agreement(plc, Lattice::none);
    expect_agreement(plc, Lattice::fcc);
  }
}

}  // namespace
}  // namespace ccdt
