#include "engine/lattice/lattice_sites.h"

#include <boost/sort/spreadsort/integer_sort.hpp>
#include <span>

namespace ccdt {

namespace {

/// Places in a cell, in halves of its side.
using CellPoint = std::array<std::uint8_t, 3>;

constexpr CellPoint corners_then_faces[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0, 0, 2},
                                            {2, 0, 2}, {0, 2, 2}, {2, 2, 2}, {1, 1, 0}, {1, 0, 1},
                                            {0, 1, 1}, {1, 1, 2}, {1, 2, 1}, {2, 1, 1}};
constexpr CellPoint corners_then_centre[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0, 0, 2},
                                             {2, 0, 2}, {0, 2, 2}, {2, 2, 2}, {1, 1, 1}};

std::span<const CellPoint> points_of_cell(Lattice kind) {
  switch (kind) {
    case Lattice::fcc:
      return corners_then_faces;
    case Lattice::bcc:
      return corners_then_centre;
    case Lattice::sc:
      return std::span(corners_then_centre).first(8);
    case Lattice::none:
      break;
  }
  return {};
}

/// Puts two zero bits between the bits of a number of 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFu;
  x = (x | x << 16) & 0x001F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

std::uint32_t gather(std::uint64_t x) {
  x &= 0x1249249249249249u;
  x = (x | x >> 2) & 0x10C30C30C30C30C3u;
  x = (x | x >> 4) & 0x100F00F00F00F00Fu;
  x = (x | x >> 8) & 0x001F0000FF0000FFu;
  x = (x | x >> 16) & 0x001F00000000FFFFu;
  return static_cast<std::uint32_t>(x | x >> 32);
}

}  // namespace

std::uint64_t morton_key(const std::array<std::uint32_t, 3>& c) {
  return spread(c[0]) | spread(c[1]) << 1 | spread(c[2]) << 2;
}

std::array<std::uint32_t, 3> Site::coordinates() const {
  return {gather(key), gather(key >> 1), gather(key >> 2)};
}

std::vector<Site> list_sites(const Octree& tree, Lattice kind) {
  const std::span<const CellPoint> cell = points_of_cell(kind);
  std::vector<Site> sites;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const OctreeNode& node = tree.nodes[i];
    if (!node.is_leaf() || node.place == NodePlace::outside) continue;
    const std::uint32_t half = tree.side(node) / 2;
    for (const CellPoint& p : cell) {
      const std::array<std::uint32_t, 3> c = {node.corner[0] + p[0] * half, node.corner[1] + p[1] * half,
                                              node.corner[2] + p[2] * half};
      if (strictly_contains(tree.bounds, tree.point(c))) sites.push_back({morton_key(c), i});
    }
  }
  boost::sort::spreadsort::integer_sort(
      sites.begin(), sites.end(), [](const Site& s, unsigned bits) { return s.key >> bits; },
      [](const Site& a, const Site& b) { return a.key < b.key; });

  // Equal keys in any order; of each group the best leaf stays.
  const auto better = [&tree](std::uint32_t a, std::uint32_t b) {
    const bool inside_a = tree.nodes[a].place == NodePlace::inside, inside_b = tree.nodes[b].place == NodePlace::inside;
    return inside_a != inside_b ? inside_a : a < b;
  };
  std::size_t kept = 0;
  for (const Site& site : sites) {
    if (kept > 0 && sites[kept - 1].key == site.key) {
      if (better(site.leaf, sites[kept - 1].leaf)) sites[kept - 1].leaf = site.leaf;
    } else {
      sites[kept++] = site;
    }
  }
  sites.resize(kept);
  return sites;
}

}  // namespace ccdt
