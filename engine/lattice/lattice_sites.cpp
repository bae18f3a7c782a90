#include "engine/lattice/lattice_sites.h"

#include <algorithm>
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

}  // namespace

std::vector<Site> list_sites(const Octree& tree, Lattice kind) {
  const std::span<const CellPoint> cell = points_of_cell(kind);
  std::vector<Site> sites;
  for (const OctreeNode& node : tree.nodes) {
    if (!node.is_leaf() || node.place == NodePlace::outside) continue;
    const std::uint32_t half = tree.side(node) / 2;
    for (const CellPoint& p : cell) {
      const std::array<std::uint32_t, 3> c = {node.corner[0] + p[0] * half, node.corner[1] + p[1] * half,
                                              node.corner[2] + p[2] * half};
      if (strictly_contains(tree.bounds, tree.point(c))) sites.push_back(site_at(c));
    }
  }
  boost::sort::spreadsort::integer_sort(sites.begin(), sites.end());
  const auto repeated = std::ranges::unique(sites);
  sites.erase(repeated.begin(), repeated.end());
  return sites;
}

}  // namespace ccdt
