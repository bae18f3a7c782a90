#include <gtest/gtest.h>

#include <set>

#include "engine/io/plc_files.h"
#include "engine/io/tet_mesh_files.h"
#include "engine/mesher.h"
#include "engine/tests/io/io_test_files.h"

// A mesh as an input: the inside is where its tetrahedra are, and its regions stay.

namespace ccdt {
namespace {

using io_test::Folder;

/// 3 x 3 x 3 unit cubes, each of six tetrahedra; `region_of(i, j, k)` is 0 for cubes that are left out.
template <class RegionOf>
mesh::TetMesh cubes(const RegionOf& region_of) {
  mesh::TetMesh mesh;
  for (std::uint32_t v = 0; v < 64; ++v) mesh.vertices.push_back({double(v % 4), double(v / 4 % 4), double(v / 16)});
  constexpr std::array<std::array<std::uint32_t, 3>, 6> orders = {
      {{1, 4, 16}, {4, 16, 1}, {16, 1, 4}, {4, 1, 16}, {1, 16, 4}, {16, 4, 1}}};
  for (std::uint32_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < 3; ++j)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const int region = region_of(i, j, k);
        if (region == 0) continue;
        const std::uint32_t first = i + 4 * j + 16 * k;
        for (std::size_t o = 0; o < 6; ++o) {
          const auto& [a, b, c] = orders[o];
          std::array t = {first, first + a, first + a + b, first + 21};
          if (o > 2) std::swap(t[2], t[3]);
          mesh.tetrahedra.push_back(t);
          mesh.regions.push_back(region);
        }
      }
  return mesh;
}

double volume_of(const mesh::TetMesh& mesh, int region) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    const Point3& p = mesh.vertices[a];
    if (mesh.regions[t] == region)
      sum += dot(cross(mesh.vertices[b] - p, mesh.vertices[c] - p), mesh.vertices[d] - p) / 6;
  }
  return sum;
}

/// Writes the mesh to a file, reads that as a surface, and meshes it.
mesh::TetMesh meshed_again(const mesh::TetMesh& mesh, const std::string& file) {
  const Folder folder;
  io::write_tet_mesh(mesh, folder / file);
  return mesh_plc(io::read_plc(folder / file)).mesh;
}

constexpr const char* formats[] = {"a.msh", "a.vtu", "a.mesh", "a.meshb"};

TEST(MeshRegions, NestedOnesStay) {
  const auto region_of = [](int i, int j, int k) { return i == 1 && j == 1 && k == 1 ? 7 : i < 2 ? 5 : 9; };
  for (const char* file : formats) {
    SCOPED_TRACE(file);
    const mesh::TetMesh mesh = meshed_again(cubes(region_of), file);
    EXPECT_NEAR(volume_of(mesh, 7), 1, 1e-9);
    EXPECT_NEAR(volume_of(mesh, 5), 17, 1e-9);
    EXPECT_NEAR(volume_of(mesh, 9), 9, 1e-9);
  }
}

TEST(MeshRegions, CavitiesStay) {
  const auto region_of = [](int i, int j, int k) { return i == 1 && j == 1 && k == 1 ? 0 : 5; };
  for (const char* file : formats) {
    SCOPED_TRACE(file);
    EXPECT_NEAR(volume_of(meshed_again(cubes(region_of), file), 5), 26, 1e-9);
  }
}

TEST(MeshRegions, PartsOfOneRegionThatTouchInAnEdgeStay) {
  const auto region_of = [](int i, int j, int k) { return k == 0 && i == j && i < 2 ? 5 : 0; };
  EXPECT_NEAR(volume_of(meshed_again(cubes(region_of), "a.vtu"), 5), 2, 1e-9);
}

TEST(MeshRegions, ListedFacesInsideAndCavitiesStayTogether) {
  const auto region_of = [](int i, int j, int k) { return i == 1 && j == 1 && k == 1 ? 0 : 5; };
  const mesh::TetMesh first = meshed_again(cubes(region_of), "a.msh");  // which lists its boundary
  EXPECT_FALSE(first.faces.empty());
  EXPECT_NEAR(volume_of(meshed_again(first, "a.mesh"), 5), 26, 1e-9);
}

}  // namespace
}  // namespace ccdt
