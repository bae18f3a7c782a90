#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <thread>
#include <utility>

#include "bench/tests/verify_cases.h"
#include "engine/base/parallel.h"
#include "engine/tests/shared/sanitized.h"

// What the verifier finds, its examples and their order are the same on any number of threads.

namespace ccdt {
namespace {

/// A mesh so large that several threads work on it. `region` is the region of each cube.
MeshedInput large_mesh(const std::function<int(int, int, int)>& region) {
  constexpr int side = is_sanitized ? 14 : 24;
  MeshedInput m = make_grid_mesh({side, side, side}, region, false, unmoved);
  m.mesh.constrained_delaunay = true;
  return m;
}

MeshedInput large_cube() {
  return large_mesh(everywhere);
}

struct Case {
  const char* name;
  bool right;
  MeshedInput meshed;
};

std::size_t random_index(std::size_t count, std::mt19937& random) {
  return random() % count;
}

Case with_inverted_tetrahedra() {
  std::mt19937 random(1);
  MeshedInput m = large_cube();
  for (int i = 0; i < 40; ++i) {
    auto& tet = m.mesh.tetrahedra[random_index(m.mesh.tetrahedra.size(), random)];
    std::swap(tet[0], tet[1]);
  }
  return {"inverted tetrahedra", false, std::move(m)};
}

Case with_moved_vertices() {
  std::mt19937 random(2);
  MeshedInput m = large_cube();
  for (int i = 0; i < 100; ++i) m.mesh.vertices[random_index(m.mesh.vertices.size(), random)].z += 0.3;
  return {"moved vertices", false, std::move(m)};
}

/// Regions leak into each other where faces between them are missing.
Case with_removed_and_doubled_tetrahedra() {
  std::mt19937 random(3);
  MeshedInput m = large_mesh([](int i, int j, int) { return i < 5 ? 1 : j < 5 ? 2 : 3; });
  auto& tetrahedra = m.mesh.tetrahedra;
  for (int i = 0; i < 60; ++i) tetrahedra[random_index(tetrahedra.size(), random)] = tetrahedra[i];
  return {"removed and doubled tetrahedra", false, std::move(m)};
}

Case with_a_facet_too_many() {
  MeshedInput m = large_mesh([](int i, int, int) { return i < 5 ? 1 : 2; });
  const auto at = [&](double x, double y, double z) {
    m.input.vertices.push_back({x, y, z});
    return static_cast<std::uint32_t>(m.input.vertices.size() - 1);
  };
  m.input.triangles.push_back({at(8.5, 3, 3), at(9, 5, 3), at(8.5, 3, 7)});
  return {"a facet too many", false, std::move(m)};
}

Case with_vertices_in_one_place() {
  MeshedInput m = large_cube();
  auto& vertices = m.mesh.vertices;
  for (std::size_t i = 1; i < 20; ++i) vertices[vertices.size() / 2 + i] = vertices[vertices.size() / 2];
  return {"vertices in one place", false, std::move(m)};
}

std::vector<Case> cases() {
  std::vector<Case> all = {{"right", true, large_cube()},
                           {"of two regions", true, large_mesh([](int i, int, int) { return i < 5 ? 1 : 2; })}};
  all.push_back(with_inverted_tetrahedra());
  all.push_back(with_moved_vertices());
  all.push_back(with_removed_and_doubled_tetrahedra());
  all.push_back(with_a_facet_too_many());
  all.push_back(with_vertices_in_one_place());
  return all;
}

void expect_same(const verify::Verification& a, const verify::Verification& b) {
  ASSERT_EQ(a.checks.size(), b.checks.size());
  for (std::size_t i = 0; i < a.checks.size(); ++i) {
    SCOPED_TRACE(a.checks[i].name);
    EXPECT_EQ(a.checks[i].name, b.checks[i].name);
    EXPECT_EQ(a.checks[i].checked, b.checks[i].checked);
    EXPECT_EQ(a.checks[i].failed, b.checks[i].failed);
    EXPECT_EQ(a.checks[i].examples, b.checks[i].examples);
  }
  EXPECT_EQ(a.mesh_volume, b.mesh_volume);
  EXPECT_EQ(a.input_volume, b.input_volume);
}

constexpr std::array<unsigned, 3> several_threads = {2, 3, 8};

TEST(VerifyThreads, FindTheSame) {
  for (const Case& c : cases()) {
    for (const auto surface : {verify::VerifyOptions::Surface::same, verify::VerifyOptions::Surface::own}) {
      const verify::VerifyOptions options{.surface = surface, .lists = verify::VerifyOptions::Lists::tetrahedra};
      const auto run = [&] { return verify::verify(c.meshed.input, c.meshed.mesh, options); };
      const verify::Verification one = with_threads(1, run);
      EXPECT_TRUE(surface == verify::VerifyOptions::Surface::own || one.ok() == c.right) << c.name << all_lines(one);
      for (const unsigned threads : several_threads) {
        SCOPED_TRACE(std::string(c.name) + " on " + std::to_string(threads) + " threads");
        expect_same(one, with_threads(threads, run));
      }
    }
  }
}

TEST(VerifyThreads, ReportProgressFromTheCallerAlone) {
  const MeshedInput m = large_cube();
  const auto caller = std::this_thread::get_id();
  std::vector<std::string> stages;
  const auto progress = [&](std::string_view stage, std::uint64_t done, std::uint64_t total) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_LE(done, total);
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  };
  with_threads(4, [&] { verify::verify(m.input, m.mesh, tetrahedra_alone, progress); });
  EXPECT_EQ(std::ranges::count(stages, "verify facets"), 1);
  struct Canceled {};
  const auto cancel = [](std::string_view, std::uint64_t, std::uint64_t) { throw Canceled(); };
  EXPECT_THROW(with_threads(4, [&] { verify::verify(m.input, m.mesh, {}, cancel); }), Canceled);
}

}  // namespace
}  // namespace ccdt
