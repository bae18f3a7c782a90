#include "bench/run/fingerprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "baselines/tests/shapes.h"
#include "engine/mesher.h"

namespace ccdt {
namespace {

TetMesh example_mesh() {
  return mesh_plc(shapes::cube_with_grid(4), {.edge_length = 0.2}).mesh;
}

template <class Type>
void shuffle(const std::vector<std::size_t>& order, std::vector<Type>& values) {
  std::vector<Type> shuffled;
  for (const std::size_t i : order) shuffled.push_back(values[i]);
  values = std::move(shuffled);
}

TEST(Fingerprint, DoesNotDependOnTheOrderOfTetrahedraAndTheirCorners) {
  TetMesh mesh = example_mesh();
  for (std::size_t t = 0; t < mesh.regions.size(); ++t) mesh.regions[t] = t % 3 == 0 ? 7 : -1;
  const std::string before = bench::fingerprint(mesh);
  EXPECT_EQ(before.size(), 32u);
  std::mt19937_64 random(1);
  std::vector<std::size_t> order(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = t;
  for (int i = 0; i < 20; ++i) {
    std::shuffle(order.begin(), order.end(), random);
    shuffle(order, mesh.tetrahedra);
    shuffle(order, mesh.regions);
    for (auto& tetrahedron : mesh.tetrahedra) std::shuffle(tetrahedron.begin(), tetrahedron.end(), random);
    EXPECT_EQ(bench::fingerprint(mesh), before);
  }
}

TEST(Fingerprint, ChangesWithEveryPartOfTheMesh) {
  const TetMesh mesh = example_mesh();
  std::set<std::string> seen = {bench::fingerprint(mesh)};
  const auto expect_new = [&](const TetMesh& changed, const char* what) {
    EXPECT_TRUE(seen.insert(bench::fingerprint(changed)).second) << what;
  };
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 7) {
    TetMesh changed = mesh;
    changed.tetrahedra[t][t % 4] =
        (changed.tetrahedra[t][t % 4] + 1) % static_cast<std::uint32_t>(mesh.vertices.size());
    expect_new(changed, "a corner");
    changed = mesh;
    changed.regions[t] += 1;
    expect_new(changed, "a region");
    changed = mesh;
    changed.tetrahedra.erase(changed.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
    changed.regions.pop_back();
    expect_new(changed, "a tetrahedron less");
    changed = mesh;
    changed.tetrahedra.push_back(mesh.tetrahedra[t]);
    changed.regions.push_back(mesh.regions[t]);
    expect_new(changed, "a tetrahedron twice");
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 5) {
    TetMesh changed = mesh;
    double& x = changed.vertices[v].x;
    x = std::nextafter(x, 9);
    expect_new(changed, "the last bit of a coordinate");
    changed = mesh;
    std::swap(changed.vertices[v], changed.vertices[(v + 1) % mesh.vertices.size()]);
    expect_new(changed, "two vertices exchanged");
  }
}

TEST(Fingerprint, ChangesWithEveryPartOfALargeMesh) {
  TetMesh mesh;
  constexpr std::uint32_t tetrahedra = 40000;
  for (std::uint32_t i = 0; i < tetrahedra + 3; ++i) mesh.vertices.push_back({1.0 * i, 0.0, 0.0});
  for (std::uint32_t i = 0; i < tetrahedra; ++i) mesh.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
  mesh.regions.assign(tetrahedra, 1);
  std::set<std::string> seen = {bench::fingerprint(mesh)};
  for (std::size_t i = 0; i < tetrahedra; i += 3000) {
    TetMesh changed = mesh;
    changed.regions[i] = 2;
    EXPECT_TRUE(seen.insert(bench::fingerprint(changed)).second) << "tetrahedron " << i;
    changed = mesh;
    changed.vertices[i].y = 1;
    EXPECT_TRUE(seen.insert(bench::fingerprint(changed)).second) << "vertex " << i;
  }
}

TEST(Fingerprint, TakesNegativeZeroForZero) {
  TetMesh mesh = shapes::cube_mesh();
  const std::string before = bench::fingerprint(mesh);
  mesh.vertices[0].x = -0.0;
  EXPECT_EQ(bench::fingerprint(mesh), before);
}

TEST(Fingerprint, IsTheSameOnEveryMachine) {
  EXPECT_EQ(bench::fingerprint({}).size(), 32u);
  EXPECT_EQ(bench::fingerprint(shapes::cube_mesh()), "2b009e8e3b6bc7fcc07083834dc59065");
}

}  // namespace
}  // namespace ccdt
