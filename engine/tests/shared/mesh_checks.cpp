#include "engine/tests/shared/mesh_checks.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ccdt::mesh_test {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = Kernel::Point_3;

/// Does the open segment pass through the triangle's inside?
bool crosses(const std::array<ExactPoint, 3>& t, const ExactPoint& p, const ExactPoint& q) {
  const auto side_of_p = CGAL::orientation(t[0], t[1], t[2], p);
  if (side_of_p == CGAL::COPLANAR || CGAL::orientation(t[0], t[1], t[2], q) != -side_of_p) return false;
  const auto turn = CGAL::orientation(p, q, t[0], t[1]);
  return turn != CGAL::COPLANAR && CGAL::orientation(p, q, t[1], t[2]) == turn &&
         CGAL::orientation(p, q, t[2], t[0]) == turn;
}

ExactPoint random_point_in(const std::array<ExactPoint, 4>& t, std::mt19937& random) {
  const auto weight = [&] { return Kernel::FT(1 + static_cast<int>(random() % 4099)); };
  return CGAL::barycenter(t[0], weight(), t[1], weight(), t[2], weight(), t[3], weight());
}

}  // namespace

std::vector<std::array<std::uint32_t, 4>> sorted_cells(const TetMesh& mesh) {
  auto cells = mesh.tetrahedra;
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  return cells;
}

void expect_same_cells(const TetMesh& a, const TetMesh& b) {
  EXPECT_TRUE(a.vertices == b.vertices);
  const auto cells_of_a = sorted_cells(a), cells_of_b = sorted_cells(b);
  EXPECT_EQ(cells_of_a.size(), cells_of_b.size());
  EXPECT_TRUE(cells_of_a == cells_of_b);
}

void expect_right(const InputPlc& input, const TetMesh& mesh, const verify::VerifyOptions& options) {
  const verify::Verification verification = verify::verify(input, mesh, options);
  for (const verify::Check& check : verification.checks)
    EXPECT_FALSE(check.required && check.failed > 0) << check.name << ": " << check.failed << " of " << check.checked
                                                     << " " << (check.examples.empty() ? "" : check.examples.front());
}

void expect_verified(const InputPlc& input, const TetMesh& mesh) {
  EXPECT_TRUE(mesh.constrained_delaunay);
  expect_right(input, mesh);
}

MeshResult expect_agreement(const InputPlc& input, Lattice lattice, Protection protection) {
  SCOPED_TRACE("lattice " + std::to_string(static_cast<int>(lattice)));
  MeshOptions options;
  options.lattice = lattice;
  options.protection = protection;
  options.improve.improvement = Improvement::none;
  options.improve.steiner = SteinerRule::keep;
  MeshResult with_check = mesh_plc(input, options);
  expect_verified(input, with_check.mesh);
  options.face_protection = false;
  expect_same_cells(with_check.mesh, mesh_plc(input, options).mesh);
  if (with_check.counts.steiner_vertices > 0) {
    options.improve.steiner = SteinerRule::remove;
    const TetMesh without = mesh_plc(input, options).mesh;
    expect_right(input, without);
    options.face_protection = true;
    EXPECT_EQ(without.tetrahedra, mesh_plc(input, options).mesh.tetrahedra);
  }
  return with_check;
}

void expect_agreement_of_all_strategies(const InputPlc& input) {
  for (const Lattice lattice : {Lattice::none, Lattice::fcc, Lattice::bcc, Lattice::sc, Lattice::refinement})
    expect_agreement(input, lattice);
  expect_agreement(input, Lattice::none, Protection::midpoint);
}

void expect_constrained_delaunay(const TetMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<ExactPoint> points;
  for (const Point3& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  const auto is_visible = [&](const ExactPoint& from, std::uint32_t v) {
    return std::none_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& f) {
      return crosses({points[f[0]], points[f[1]], points[f[2]]}, from, points[v]);
    });
  };
  for (const auto& cell : mesh.tetrahedra) {
    const std::array t = {points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]};
    ASSERT_EQ(CGAL::orientation(t[0], t[1], t[2], t[3]), CGAL::POSITIVE);
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      if (CGAL::side_of_bounded_sphere(t[0], t[1], t[2], t[3], points[v]) != CGAL::ON_BOUNDED_SIDE) continue;
      for (int i = 0; i < 4; ++i)
        EXPECT_FALSE(is_visible(random_point_in(t, random), v))
            << "vertex " << v << " from " << cell[0] << " " << cell[1] << " " << cell[2] << " " << cell[3];
    }
  }
}

}  // namespace ccdt::mesh_test
