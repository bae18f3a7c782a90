#include "engine/mesh/collect_tetrahedra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/mesher.h"
#include "engine/tests/front/front_stages.h"
#include "engine/tests/improve/improve_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tets/cell_complex.h"

// The neighbors that cells keep from the Delaunay tetrahedralization must be those found by matching corners of faces.

namespace ccdt {
namespace {

using namespace mesh_test;

std::size_t count_joined(const LargeVector<delaunay::Cell>& cells) {
  std::size_t joined = 0;
  for (const delaunay::Cell& cell : cells)
    joined += 4 - static_cast<std::size_t>(std::ranges::count(cell.neighbors, delaunay::no_neighbor));
  return joined;
}

/// \return  how many faces, seen from both sides, the Delaunay cells had in common
std::size_t expect_neighbors_kept(const Stages& s, const front::FrontResult& front,
                                  const std::vector<std::uint32_t>& codes) {
  const auto regions = label::label_cells(s.plc, s.delaunay, front.open, codes);
  mesh::CollectedMesh collected =
      mesh::collect_tetrahedra(s.plc, front, regions, s.delaunay.cells, s.delaunay.vertices.size());
  std::vector<Point3> points;
  for (const auto& vertex : s.delaunay.vertices) points.push_back(vertex.point);
  const auto facet_of_face = mesh::finish_mesh(s.plc, s.chains, points, s.facets, collected);
  const auto joined = mesh::join_tetrahedra(collected.mesh, collected.sources, s.delaunay.cells);
  const auto complex_of = [&](LargeVector<delaunay::Cell> cells) {
    return tets::CellComplex(collected.mesh.faces, collected.mesh.edges, std::move(cells), collected.mesh.regions,
                             points, facet_of_face, static_cast<std::uint32_t>(points.size()), {});
  };
  const tets::CellComplex kept = complex_of(joined), found = complex_of(improve_test::unjoined_cells(collected.mesh));
  improve_test::expect_consistent(kept);
  for (std::uint32_t c = 0; c < joined.size(); ++c) {
    EXPECT_EQ(kept.cell(CellId(c)).vertices, collected.mesh.tetrahedra[c]) << "cell " << c;
    EXPECT_EQ(kept.cell(CellId(c)).neighbors, found.cell(CellId(c)).neighbors) << "cell " << c;
  }
  return count_joined(joined);
}

void expect_neighbors_kept(const plc::InputPlc& input) {
  const Stages s(input);
  expect_neighbors_kept(s, s.advance(), s.codes);
  const std::vector<std::uint32_t> none(s.codes.size(), delaunay::no_neighbor);
  expect_neighbors_kept(s, s.advance_all(), none);
}

TEST(JoinTetrahedra, KeepsNeighborsOfDelaunayCells) {
  std::mt19937 random(7);
  const Stages convex(random_convex(40, random));
  EXPECT_GT(expect_neighbors_kept(convex, convex.advance(), convex.codes), 0u);
}

TEST(JoinTetrahedra, LeavesCellsOfTheFrontWithoutNeighbors) {
  const Stages cube(unit_cube());
  const std::vector<std::uint32_t> none(cube.codes.size(), delaunay::no_neighbor);
  const front::FrontResult front = cube.advance_all();
  EXPECT_FALSE(front.tetrahedra.empty());
  EXPECT_EQ(expect_neighbors_kept(cube, front, none), 0u);
}

TEST(JoinTetrahedra, AgreesWithTheCornersOfFaces) {
  for (const plc::InputPlc& input : {cube_within_cube(), two_cubes(), cube_with_slit(), cube_with_dangling_facet(),
                                     cube_with_turnstile(), twisted_prism(3, 0.3), twisted_prism(12, -0.5)})
    expect_neighbors_kept(input);
}

TEST(JoinTetrahedra, AgreesWithTheCornersOfFacesOfRandomPlcs) {
  std::mt19937 random(11);
  for (int i = 0; i < 10; ++i) expect_neighbors_kept(random_convex(12 + i, random));
  for (int i = 0; i < 4; ++i) expect_neighbors_kept(random_voxels(3, 2, random));
}

}  // namespace
}  // namespace ccdt
