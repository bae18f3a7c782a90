#include "engine/improver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/mesher.h"
#include "engine/tests/shared/mesh_checks.h"
#include "engine/tests/shared/mesh_test_solids.h"
#include "engine/tets/cell_quality.h"

namespace ccdt {
namespace {

/// A mesh as another program may write it: some vertices and all tetrahedra in another order, half of the latter turned
/// over.
TetMesh shuffled(TetMesh mesh, unsigned seed) {
  std::mt19937 random{seed};
  std::vector<std::uint32_t> order(mesh.vertices.size()), number(mesh.vertices.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  std::ranges::shuffle(order, random);
  TetMesh other = mesh;
  for (std::uint32_t i = 0; i < order.size(); ++i) number[order[i]] = i, other.vertices[i] = mesh.vertices[order[i]];
  for (auto& t : other.tetrahedra) {
    for (std::uint32_t& v : t) v = number[v];
    if (random() % 2 == 0) std::swap(t[0], t[1]);
  }
  for (auto& face : other.faces)
    for (std::uint32_t& v : face) v = number[v];
  for (auto& edge : other.edges)
    for (std::uint32_t& v : edge) v = number[v];
  return other;
}

double worst_r(const TetMesh& mesh) {
  double worst = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    worst = std::max(
        worst, 1 / std::fabs(tets::inverse_r(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d])));
  return worst;
}

TetMesh unimproved(const InputPlc& input) {
  MeshOptions options{.edge_length = 0.2};
  options.improve.improvement = Improvement::none;
  return mesh_plc(input, options).mesh;
}

TEST(Improver, MakesMeshesOfAnyOriginBetterAndKeepsTheirSurface) {
  for (const auto& [name, input] : mesh_test::small_inputs()) {
    if (std::string_view(name) == "floating segment") continue;  // a mesh does not know its free vertices
    SCOPED_TRACE(name);
    const TetMesh mesh = unimproved(input);
    const ImprovedMesh improved = improve_tet_mesh(shuffled(mesh, 1));
    mesh_test::expect_right(input, improved.mesh);
    EXPECT_LE(worst_r(improved.mesh), worst_r(mesh));
    EXPECT_EQ(improved.mesh.faces.size(), mesh.faces.size());
    EXPECT_EQ(improved.mesh.edges.size(), mesh.edges.size());
  }
}

TEST(Improver, ReachesTheTargetWhereTheSurfaceAllows) {
  const InputPlc cube = plc_test::rotated(mesh_test::oblique, plc_test::gridded_cube(5));
  TetMesh partitioned = unimproved(cube);
  partitioned.partitions.assign(partitioned.tetrahedra.size(), 1);
  const ImprovedMesh improved = improve_tet_mesh(partitioned);
  EXPECT_TRUE(improved.mesh.partitions.empty()) << "they were of other tetrahedra";
  EXPECT_GT(improved.counts.bad_cells, 0u);
  EXPECT_EQ(improved.counts.stop, ImproveStop::target);
  EXPECT_LE(worst_r(improved.mesh), 2.0 + 1e-9);
}

TEST(Improver, FindsTheBoundaryAndTheFacesBetweenRegionsByItself) {
  const InputPlc input = mesh_test::two_cubes();
  TetMesh bare = unimproved(input);
  const std::size_t faces = bare.faces.size();
  bare.faces.clear(), bare.face_markers.clear(), bare.edges.clear(), bare.edge_markers.clear();
  const ImprovedMesh improved = improve_tet_mesh(bare);
  EXPECT_EQ(improved.mesh.faces.size(), faces);
  EXPECT_EQ(improved.mesh.face_markers, std::vector<int>(faces, 0));
  std::set<int> regions(improved.mesh.regions.begin(), improved.mesh.regions.end());
  EXPECT_EQ(regions.size(), 2u);
}

TEST(Improver, MakesTheSameMeshOnAnyNumberOfThreads) {
  const TetMesh mesh = unimproved(plc_test::rotated(mesh_test::oblique, plc_test::gridded_cube(5)));
  const TetMesh one = improve_tet_mesh(mesh, {}, 1).mesh, three = improve_tet_mesh(mesh, {}, 3).mesh;
  EXPECT_EQ(one.tetrahedra, three.tetrahedra);
  EXPECT_EQ(one.vertices, three.vertices);
}

TEST(Improver, RefusesWhatIsNoMesh) {
  const TetMesh mesh = unimproved(plc_test::unit_cube());
  const auto expect_refused = [&](const auto& spoil) {
    TetMesh spoiled = mesh;
    spoil(spoiled);
    EXPECT_THROW(improve_tet_mesh(spoiled), InputError);
  };
  expect_refused([](TetMesh& m) { m.tetrahedra.clear(); });
  expect_refused([](TetMesh& m) { m.tetrahedra[0][1] = 1'000'000; });
  expect_refused([](TetMesh& m) { m.tetrahedra[0][1] = m.tetrahedra[0][2]; });
  expect_refused([](TetMesh& m) { m.tetrahedra.push_back(m.tetrahedra[0]); });
  expect_refused([](TetMesh& m) { m.vertices[0].x = HUGE_VAL; });
  expect_refused([](TetMesh& m) {
    m.faces.push_back(m.faces[0]);
    m.face_markers.push_back(0);
  });
  expect_refused([](TetMesh& m) { m.faces[0] = {0, 0, 1}; });
  expect_refused([](TetMesh& m) { m.face_markers.pop_back(); });
  expect_refused([](TetMesh& m) {
    m.edges.push_back({0, 0});
    m.edge_markers.push_back(0);
  });
  EXPECT_THROW(improve_tet_mesh(mesh, {.target_r = 0}), InputError);
}

}  // namespace
}  // namespace ccdt
