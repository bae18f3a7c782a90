#include "engine/lattice/sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/tests/lattice/lattice_shapes.h"

namespace ccdt::test {
namespace {

/// Is a point one of the lattice, given its place in a cell in halves of the side?
bool is_in_lattice(lattice::Lattice kind, const std::array<std::uint32_t, 3>& halves) {
  const auto odd = std::ranges::count_if(halves, [](std::uint32_t half) { return half % 2 == 1; });
  return odd == 0 || (kind == lattice::Lattice::fcc && odd == 2) || (kind == lattice::Lattice::bcc && odd == 3);
}

/// All lattice points of all leaves, also on their upper faces.
std::set<lattice::Site> sites_of_all_leaves(const lattice::Octree& tree, lattice::Lattice kind) {
  std::set<lattice::Site> sites;
  for (const lattice::OctreeNode& node : tree.nodes) {
    if (!node.is_leaf() || node.place == lattice::NodePlace::outside) continue;
    for (std::uint32_t i = 0; i < 27; ++i) {
      const std::array<std::uint32_t, 3> halves = {i % 3, i / 3 % 3, i / 9};
      std::array<std::uint32_t, 3> c{};
      for (std::size_t k = 0; k < 3; ++k) c[k] = node.corner[k] + halves[k] * tree.side(node) / 2;
      if (is_in_lattice(kind, halves) && strictly_contains(tree.bounds, tree.point(c)) &&
          tree.leaf_at(c).place != lattice::NodePlace::outside)
        sites.insert(lattice::site_at(c));
    }
  }
  return sites;
}

TEST(LatticeSites, AreTheLatticePointsOfAllLeaves) {
  const auto corner = [](int x, int y, int z) { return x + y + z < 4 ? 1 : 0; };
  for (const Shape& shape : {cube_with_a_fine_corner(), sphere(2), cubes(3, corner, true)})
    for (const lattice::Lattice kind : lattices)
      for (const double grading : {0.0, 0.5, 2.0}) {
        const lattice::DomainSurface surface = surface_of(shape);
        const lattice::Octree tree =
            lattice::build_octree(surface, lattice::target_sizes(surface, 0.4 * shape.unit, grading), kind);
        const std::set<lattice::Site> sites = sites_of_all_leaves(tree, kind);
        EXPECT_GT(sites.size(), 100u);
        for (const unsigned threads : {1u, 3u})
          with_threads(threads, [&] { EXPECT_TRUE(std::ranges::equal(lattice::list_sites(tree, kind), sites)); });
      }
}

/// The coordinates of the sites of an FCC lattice with this step in a cube.
std::vector<std::array<std::uint32_t, 3>> cube_of_sites(std::uint32_t step, std::uint32_t count) {
  std::vector<std::array<std::uint32_t, 3>> sites;
  for (std::uint32_t x = 0; x < count; ++x)
    for (std::uint32_t y = 0; y < count; ++y)
      for (std::uint32_t z = (x + y) % 2; z < count; z += 2) sites.push_back({x * step, y * step, z * step});
  return sites;
}

TEST(LaterRounds, DivideALatticeIntoCoarserOnes) {
  for (const unsigned log_step : {0u, 1u, 5u}) {
    std::array<std::size_t, 16> at_least{};  // how many sites have at least so many later rounds
    for (const auto& c : cube_of_sites(1u << log_step, 16)) {
      const unsigned later = lattice::later_rounds(lattice::site_at(c), log_step);
      for (unsigned k = 0; k < at_least.size(); ++k) at_least[k] += later >= k;
      // Simple cubic with steps of 2^k: `later` is at least 2k. Face-centered: at least 2k + 1.
      for (unsigned k = 0; k < 4; ++k) {
        const std::uint32_t step = 1u << (log_step + k);
        const bool in_cubic = c[0] % step == 0 && c[1] % step == 0 && c[2] % step == 0;
        ASSERT_EQ(later >= 2 * k, in_cubic);
        ASSERT_EQ(later >= 2 * k + 1, in_cubic && (c[0] / step + c[1] / step + c[2] / step) % 2 == 0);
      }
    }
    EXPECT_EQ(at_least[1], 2048u);
    EXPECT_EQ(at_least[2], 512u);
    EXPECT_EQ(at_least[3], 256u);
    EXPECT_EQ(at_least[4], 64u);
  }
}

TEST(LaterRounds, TakesTheBodyCenteredPointsLast) {
  EXPECT_EQ(lattice::later_rounds(lattice::site_at({1, 1, 1}), 0), 0);
  EXPECT_EQ(lattice::later_rounds(lattice::site_at({8, 8, 24}), 3), 0);
}

}  // namespace
}  // namespace ccdt::test
