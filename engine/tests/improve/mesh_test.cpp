#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "engine/improve/improve_mesh.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tets/cell_complex.h"
#include "models/solids.h"

// Improves whole meshes of inputs of every kind, and verifies them by means other than the engine's.

namespace ccdt {
namespace {

using namespace mesh_test;
using Rational = boost::multiprecision::cpp_rational;

MeshOptions options_of(Improvement improvement, Objective objective = Objective::r,
                       BoundaryRule boundary = BoundaryRule::keep) {
  MeshOptions options;
  options.improve.improvement = improvement;
  options.improve.objective = objective;
  options.improve.boundary = boundary;
  options.improve.steiner = SteinerRule::keep;
  options.improve.target_dihedral = 40;  // so that there is always something to do
  return options;
}

Rational sixfold_volume(const TetMesh& mesh) {
  using Vector = std::array<Rational, 3>;
  const auto edge = [&](std::uint32_t from, std::uint32_t to) {
    const auto a = as_array(mesh.vertices[from]), b = as_array(mesh.vertices[to]);
    Vector result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = Rational(b[i]) - Rational(a[i]);
    return result;
  };
  Rational sum = 0;
  for (const auto& t : mesh.tetrahedra) {
    const Vector u = edge(t[0], t[1]), v = edge(t[0], t[2]), w = edge(t[0], t[3]);
    sum += u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
  }
  return sum;
}

/// The least value over all tetrahedra of 1 / r and of the sine of a dihedral angle.
struct WorstShape {
  double inverse_r = 1, least_sine = 1;
};

WorstShape worst_shape(const TetMesh& mesh) {
  WorstShape worst;
  for (const auto& t : mesh.tetrahedra) {
    const auto& at = mesh.vertices;
    worst.inverse_r = std::min(worst.inverse_r, tets::inverse_r(at[t[0]], at[t[1]], at[t[2]], at[t[3]]));
    worst.least_sine = std::min(worst.least_sine, tets::least_sine(at[t[0]], at[t[1]], at[t[2]], at[t[3]]));
  }
  return worst;
}

void expect_not_worse(const TetMesh& before, const TetMesh& after, const ImproveOptions& options) {
  constexpr double rounding = 1e-9;
  const WorstShape old_worst = worst_shape(before), new_worst = worst_shape(after);
  const tets::QualityGoal goal = improve::goal_of(options);
  if (options.objective == Objective::r) {
    EXPECT_GE(new_worst.inverse_r, std::min(old_worst.inverse_r, goal.inverse_r) - rounding);
  } else {
    EXPECT_GE(new_worst.least_sine, std::min(old_worst.least_sine, goal.sine) - rounding);
  }
}

/// The greatest distance that any of the first `vertices` vertices has moved from one mesh to the other.
double farthest_move(const TetMesh& a, const TetMesh& b, std::size_t vertices) {
  double square = 0;
  for (std::size_t v = 0; v < vertices; ++v) square = std::max(square, squared_length(b.vertices[v] - a.vertices[v]));
  return std::sqrt(square);
}

bool anything_done(const ImproveCounts& c) {
  return c.removed_edges + c.removed_faces + c.moved_vertices + c.inserted_vertices + c.collapsed_edges > 0;
}

/// Everything that must hold for an improved mesh, whatever the input.
///
/// \return how far a vertex of the input, or a Steiner vertex, has moved
double expect_improved(const InputPlc& input, const MeshResult& plain, const MeshOptions& options) {
  const MeshResult result = mesh_plc(input, options);
  const TetMesh &before = plain.mesh, &after = result.mesh;
  expect_right(input, after,
               {.boundary = options.improve.boundary == BoundaryRule::slide ? verify::VerifyOptions::Boundary::slide
                                                                            : verify::VerifyOptions::Boundary::keep});
  expect_not_worse(before, after, options.improve);
  EXPECT_NE(result.counts.improve.stop, ImproveStop::none);
  EXPECT_EQ(after.constrained_delaunay, !anything_done(result.counts.improve));
  EXPECT_EQ(result.counts.vertices, after.vertices.size());
  EXPECT_EQ(result.counts.tetrahedra, after.tetrahedra.size());
  EXPECT_EQ(after.faces.size(), before.faces.size());
  EXPECT_EQ(after.face_markers, before.face_markers);
  EXPECT_EQ(after.edges, before.edges);
  EXPECT_EQ(after.edge_markers, before.edge_markers);
  const std::size_t kept = before.vertices.size() - plain.counts.interior_vertices;
  EXPECT_EQ(kept, after.vertices.size() - result.counts.interior_vertices);
  const double rounding = 4 * plain.largest_rounding;  // whether it is undone depends on the tetrahedra around
  const double moved = farthest_move(before, after, kept);
  const double input_moved = farthest_move(before, after, kept - plain.counts.steiner_vertices);
  EXPECT_TRUE(options.improve.boundary == BoundaryRule::slide || input_moved <= rounding) << input_moved;
  if (options.improve.improvement == Improvement::swap) {
    EXPECT_EQ(after.vertices.size(), before.vertices.size());
    EXPECT_LE(farthest_move(before, after, before.vertices.size()), rounding);
  }
  EXPECT_TRUE(options.improve.improvement != Improvement::smooth || sorted_cells(after) == sorted_cells(before));
  return moved;
}

template <class Visit>
void visit_options(const Visit& visit) {
  for (const Improvement improvement : {Improvement::swap, Improvement::smooth, Improvement::all})
    for (const Objective objective : {Objective::r, Objective::dihedral})
      for (const BoundaryRule boundary : {BoundaryRule::keep, BoundaryRule::slide}) {
        SCOPED_TRACE("improvement " + std::to_string(static_cast<int>(improvement)) + ", objective " +
                     std::to_string(static_cast<int>(objective)) + ", boundary " +
                     std::to_string(static_cast<int>(boundary)));
        visit(options_of(improvement, objective, boundary));
      }
}

/// \return how far a vertex of the input, or a Steiner vertex, has moved at most
double expect_improved_by_all_means(const InputPlc& input, Lattice lattice, double edge_length = 0) {
  MeshOptions plain_options = options_of(Improvement::none);
  plain_options.lattice = lattice;
  plain_options.edge_length = edge_length;
  const MeshResult plain = mesh_plc(input, plain_options);
  double moved = 0;
  visit_options([&](MeshOptions options) {
    options.lattice = lattice;
    options.edge_length = edge_length;
    moved = std::max(moved, expect_improved(input, plain, options));
  });
  return moved;
}

TEST(ImprovedMesh, SmallInputs) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_improved_by_all_means(plc, Lattice::fcc, 0.7);
  }
}

TEST(ImprovedMesh, SmallInputsRotated) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_improved_by_all_means(rotated(oblique, plc), Lattice::bcc, 0.8);
  }
}

TEST(ImprovedMesh, SmallInputsWithoutInteriorVertices) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    expect_improved_by_all_means(plc, Lattice::none);
  }
}

TEST(ImprovedMesh, FacetsWithVerticesInsidePlainAndRotated) {
  for (const InputPlc& plc : {gridded_cube(3), gridded_plate(4, 0.1)}) {
    EXPECT_GT(expect_improved_by_all_means(plc, Lattice::fcc), 0.01);
    expect_improved_by_all_means(rotated(oblique, plc), Lattice::fcc);
  }
}

TEST(ImprovedMesh, MovesSteinerVerticesAlongSegmentsAndKeepsThoseOfTheInput) {
  const InputPlc prism = twisted_prism(6, 0.25);
  const MeshResult plain = mesh_plc(prism, options_of(Improvement::none));
  const MeshResult improved = mesh_plc(prism, options_of(Improvement::all));
  expect_right(prism, improved.mesh);
  const std::size_t of_input = prism.vertices.size(), kept = of_input + plain.counts.steiner_vertices;
  EXPECT_GT(farthest_move(plain.mesh, improved.mesh, kept), 0.001);
  EXPECT_LT(farthest_move(plain.mesh, improved.mesh, of_input), 1e-8);
}

TEST(ImprovedMesh, RandomVoxelsAndRoughSurfaces) {
  std::mt19937 random(1);
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    const InputPlc voxels = random_voxels(2 + i % 2, 2 + i % 2, random);
    expect_improved_by_all_means(in_perspective(voxels, 2 + i % 2), Lattice::fcc);
    expect_improved_by_all_means(rotated(random_rotation(random), voxels), Lattice::sc, 0.6);
    expect_improved_by_all_means(roughened(models::make_solid("sphere", 0.7), 0.4, random), Lattice::fcc);
  }
}

TEST(ImprovedMesh, HasExactlyTheVolumeOfTheInput) {
  const auto exact_volume = [](const InputPlc& plc, MeshOptions options) {
    options.edge_length = 0.5;
    return sixfold_volume(mesh_plc(plc, options).mesh);
  };
  visit_options([&](const MeshOptions& options) {
    EXPECT_EQ(exact_volume(unit_cube(), options), 6);
    EXPECT_EQ(exact_volume(l_shape(), options), 18);
    EXPECT_EQ(exact_volume(gridded_cube(4), options), 6);
    EXPECT_EQ(exact_volume(cube_with_cubic_hole(), options), 6 * 26);
  });
}

TEST(ImprovedMesh, IsTheSameWhateverTheStrategyAndInEveryRun) {
  for (const auto& [name, plc] :
       {Named{"bars", two_bars()}, Named{"turnstile", rotated(oblique, cube_with_turnstile())},
        Named{"cubes", cube_within_cube()}, Named{"cube", gridded_cube(4)}}) {
    SCOPED_TRACE(name);
    MeshOptions options = options_of(Improvement::all, Objective::r, BoundaryRule::slide);
    options.edge_length = 0.8, options.least_core = 0;
    options.improve.steiner = SteinerRule::remove;
    const TetMesh first = mesh_plc(plc, options).mesh;
    expect_same_cells(first, mesh_plc(plc, options).mesh);
    for (const DelaunayMethod method : {DelaunayMethod::insert, DelaunayMethod::core, DelaunayMethod::wrap})
      for (const LocatorKind locator : {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity})
        for (const bool check : {true, false}) {
          options.delaunay = method, options.locator = locator, options.face_protection = check;
          expect_same_cells(first, mesh_plc(plc, options).mesh);
        }
  }
}

TEST(ImprovedMesh, NoneLeavesTheConstrainedDelaunayTetrahedralization) {
  for (const auto& [name, plc] : small_inputs()) {
    SCOPED_TRACE(name);
    const MeshResult result = mesh_plc(plc, options_of(Improvement::none, Objective::dihedral, BoundaryRule::slide));
    EXPECT_TRUE(result.mesh.constrained_delaunay);
    EXPECT_EQ(result.counts.improve.stop, ImproveStop::none);
    expect_same_cells(result.mesh, mesh_plc(plc, options_of(Improvement::none)).mesh);
  }
}

TEST(ImprovedMesh, SaysWhyItStopped) {
  const InputPlc cube = gridded_cube(4);
  MeshOptions options = options_of(Improvement::all);
  options.improve.target_dihedral = 1, options.improve.target_r = 1e6;
  EXPECT_EQ(mesh_plc(cube, options).counts.improve.stop, ImproveStop::target);
  options.improve.target_dihedral = 60, options.improve.target_r = 1;
  EXPECT_EQ(mesh_plc(cube, options).counts.improve.stop, ImproveStop::stuck);
  options.improve.time = 1e-9;
  const MeshResult result = mesh_plc(cube, options);
  EXPECT_EQ(result.counts.improve.stop, ImproveStop::time);
  expect_right(cube, result.mesh);
}

}  // namespace
}  // namespace ccdt
