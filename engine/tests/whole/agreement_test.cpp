#include <gtest/gtest.h>

#include <utility>

#include "engine/io/plc_files.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tests/shared/real_parts.h"
#include "engine/tests/shared/sanitized.h"
#include "models/solids.h"

// The constrained Delaunay tetrahedralization is unique, so every strategy must find the same tetrahedra, and the
// result is verified by means other than the engine's.

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
      options.improve.steiner = SteinerRule::keep;
      expect_constrained_delaunay(mesh_plc(plc, options).mesh, 1);
    }
  }
}

TEST(Agreement, ModelsAtThreeDensities) {
  for (const char* name : {"piston", "bracket", "stepping-pole"})
    for (const double edge_length : {5.0, 7.0, 11.0}) {
      if (is_sanitized && edge_length < 7) continue;
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

/// Meshes with `insert` and `core`.
///
/// \return  how many tetrahedra of lattice cores there were
std::uint64_t expect_agreement_with_cores(const InputPlc& input, double edge_length,
                                          std::initializer_list<double> gradings,
                                          const std::vector<Improvement>& improvements = {Improvement::none},
                                          double sphere_factor = 1) {
  std::uint64_t core_tetrahedra = 0;
  for (const Lattice kind : {Lattice::fcc, Lattice::bcc, Lattice::sc})
    for (const double grading : gradings)
      for (const Improvement improvement : improvements) {
        SCOPED_TRACE("lattice " + std::to_string(static_cast<int>(kind)) + ", grading " + std::to_string(grading));
        MeshOptions options;
        options.lattice = kind, options.edge_length = edge_length, options.grading = grading;
        options.sphere_factor = sphere_factor;
        options.improve.improvement = improvement;
        options.delaunay = DelaunayMethod::insert;
        const MeshResult inserted = mesh_plc(input, options);
        options.delaunay = DelaunayMethod::core, options.least_core = 0;
        const MeshResult with_core = mesh_plc(input, options);
        expect_same_cells(inserted.mesh, with_core.mesh);
        if (improvement == Improvement::all) {
          EXPECT_TRUE(inserted.mesh.tetrahedra == with_core.mesh.tetrahedra);
        }
        EXPECT_EQ(inserted.counts.dropped_interior_vertices, with_core.counts.dropped_interior_vertices);
        core_tetrahedra += with_core.counts.core_tetrahedra;
      }
  return core_tetrahedra;
}

TEST(Agreement, CoresOfLatticesInPrimitives) {
  for (const auto& [name, edge_length] : {std::pair{"cube", 0.25}, {"sphere", 0.25}, {"torus", 0.3}}) {
    SCOPED_TRACE(name);
    const InputPlc plc = models::make_solid(name, edge_length);
    EXPECT_GT(expect_agreement_with_cores(plc, 0.11, {0}), 0u);
    EXPECT_GT(expect_agreement_with_cores(rotated(oblique, plc), 0.13, {0}, {Improvement::all}), 0u);
    expect_agreement_with_cores(plc, 0, {0, 0.2, 0.5});
  }
}

TEST(Agreement, CoresOfLatticesOfSeveralLevels) {
  EXPECT_GT(expect_agreement_with_cores(models::make_solid("sphere", 0.13), 0, {0.1, 0.3, 1}), 0u);
  EXPECT_GT(expect_agreement_with_cores(rotated(oblique, models::make_solid("graded-cube", 0.25)), 0, {0.3, 1}), 0u);
}

TEST(Agreement, CoresOfLatticesBesideInteriorFacetsAndProtectedEdges) {
  std::uint64_t core_tetrahedra = 0;
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    core_tetrahedra += expect_agreement_with_cores(plc, 0.35, {0, 0.5}, {Improvement::none}, 0.2);
    if (is_sanitized) continue;
    core_tetrahedra += expect_agreement_with_cores(rotated(oblique, plc), 0.3, {0}, {Improvement::none}, 0);
  }
  EXPECT_GT(core_tetrahedra, 0u);
}

TEST(Agreement, CoresOfLatticesInRandomBodies) {
  std::mt19937 random(5);
  std::uint64_t core_tetrahedra = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const InputPlc voxels = random_voxels(2 + static_cast<int>(i) % 2, 2, random);
    const InputPlc rough = roughened(models::make_solid("sphere", i % 2 == 0 ? 0.35 : 0.2), 0.3, random);
    core_tetrahedra += expect_agreement_with_cores(rotated(random_rotation(random), voxels), 0.25 + 0.02 * i, {0});
    core_tetrahedra += expect_agreement_with_cores(rough, 0.13 + 0.01 * i, {0, 0.3});
  }
  EXPECT_GT(core_tetrahedra, 0u);
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
