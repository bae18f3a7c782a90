#include "bench/experiments/inside_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/tests/grid_mesh.h"

namespace ccdt {
namespace {

/// Cubes in a grid of six in each direction, with the faces between regions.
mesh::TetMesh grid_with_faces(const CubeRegion& region) {
  MeshedInput made = make_grid_mesh({6, 6, 6}, region, false, unmoved);
  made.mesh.faces = made.input.triangles;
  return made.mesh;
}

TEST(InsideCells, HaveNoVertexOnTheSurfaceOrJoinedToIt) {
  const mesh::TetMesh inside = experiments::inside_cells(grid_with_faces([](int, int, int) { return 1; }));
  EXPECT_EQ(inside.tetrahedra.size(), 2u * 2 * 2 * 6);  // the cubes whose corners are two edges away
  EXPECT_EQ(inside.regions.size(), inside.tetrahedra.size());
  const auto are_away = [&](const auto& tetrahedron) {
    return std::ranges::all_of(tetrahedron, [&](std::uint32_t v) {
      const Point3& p = inside.vertices[v];
      return std::min({p.x, p.y, p.z}) > 1.5 && std::max({p.x, p.y, p.z}) < 4.5;
    });
  };
  EXPECT_TRUE(std::ranges::all_of(inside.tetrahedra, are_away));
}

TEST(InsideCells, AreAwayFromInteriorFacetsAsWell) {
  const mesh::TetMesh halves = grid_with_faces([](int x, int, int) { return x < 3 ? 1 : 2; });
  EXPECT_TRUE(experiments::inside_cells(halves).tetrahedra.empty());
}

}  // namespace
}  // namespace ccdt
