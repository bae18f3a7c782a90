#include "engine/lattice/sites.h"

#include <algorithm>
#include <boost/sort/spreadsort/integer_sort.hpp>
#include <functional>
#include <iterator>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt::lattice {
namespace {

/// Places in a cell, in halves of its side. The places that the leaf itself holds, all below 2, are in Morton order.
using CellPoint = std::array<std::uint8_t, 3>;

constexpr CellPoint corners_then_faces[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0, 0, 2},
                                            {2, 0, 2}, {0, 2, 2}, {2, 2, 2}, {1, 1, 0}, {1, 0, 1},
                                            {0, 1, 1}, {1, 1, 2}, {1, 2, 1}, {2, 1, 1}};
constexpr CellPoint corners_then_center[] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0, 0, 2},
                                             {2, 0, 2}, {0, 2, 2}, {2, 2, 2}, {1, 1, 1}};

std::span<const CellPoint> points_of_cell(Lattice kind) {
  switch (kind) {
    case Lattice::fcc:
      return corners_then_faces;
    case Lattice::bcc:
      return corners_then_center;
    case Lattice::sc:
      return std::span(corners_then_center).first(8);
    case Lattice::none:
    case Lattice::refinement:
      break;
  }
  return {};
}

/// A node, and the nodes beyond its upper sides: entry i is one side length further along the axes whose bits are set
/// in i. They have the level of the node, or are coarser leaves; `none` beyond the root.
using Upward = std::array<std::uint32_t, 8>;

Upward upward_of_child(const Octree& tree, const Upward& parent, std::uint32_t child) {
  Upward result;
  for (std::uint32_t i = 0; i < 8; ++i) {
    // Along axes whose bit is set in both, the step leaves the parent.
    const std::uint32_t beyond = parent[child & i];
    const bool is_end = beyond == none || tree.nodes[beyond].is_leaf();
    result[i] = is_end ? beyond : tree.nodes[beyond].first_child + (child ^ i);
  }
  return result;
}

/// The roots of the subtrees that are left after cutting off a tree's top, in Morton order.
std::vector<Upward> cut_off_top(const Octree& tree, std::size_t least_nodes) {
  std::vector<Upward> nodes = {{0, none, none, none, none, none, none, none}};
  for (bool grows = true; grows && nodes.size() < least_nodes;) {
    std::vector<Upward> next;
    for (const Upward& node : nodes) {
      if (tree.nodes[node[0]].is_leaf())
        next.push_back(node);
      else
        for (std::uint32_t c = 0; c < 8; ++c) next.push_back(upward_of_child(tree, node, c));
    }
    grows = next.size() > nodes.size();
    nodes = std::move(next);
  }
  return nodes;
}

/// Each leaf holds its lower faces, so it lists the sites there and inside. Those on its upper faces are sites of the
/// leaves beyond, unless these are coarser.
struct SiteLists {
  std::vector<Site> in_leaves;   ///< in Morton order
  std::vector<Site> in_coarser;  ///< in any order, perhaps repeatedly

  void add_below(const Octree& tree, std::span<const CellPoint> cell, const Upward& upward) {
    const OctreeNode& node = tree.nodes[upward[0]];
    if (!node.is_leaf()) {
      for (std::uint32_t c = 0; c < 8; ++c) add_below(tree, cell, upward_of_child(tree, upward, c));
      return;
    }
    if (node.place == NodePlace::outside) return;
    const std::uint32_t half = tree.side(node) / 2;
    for (const CellPoint& p : cell) {
      const unsigned direction = p[0] / 2u + p[1] / 2u * 2 + p[2] / 2u * 4;
      if (direction != 0 && !is_coarser(tree, node, upward[direction])) continue;
      const std::array<std::uint32_t, 3> c = {node.corner[0] + p[0] * half, node.corner[1] + p[1] * half,
                                              node.corner[2] + p[2] * half};
      if (strictly_contains(tree.bounds, tree.point(c)))
        (direction == 0 ? in_leaves : in_coarser).push_back(site_at(c));
    }
  }

 private:
  static bool is_coarser(const Octree& tree, const OctreeNode& node, std::uint32_t other) {
    return other != none && tree.nodes[other].level < node.level && tree.nodes[other].place != NodePlace::outside;
  }
};

}  // namespace

std::vector<Site> list_sites(const Octree& tree, Lattice kind) {
  const std::size_t least_nodes = thread_count() == 1 ? 1 : 64 * thread_count();
  const std::vector<Upward> nodes = cut_off_top(tree, least_nodes);
  const std::vector<SiteLists> parts = parallel_chunks(nodes.size(), 4, [&](std::size_t i, std::size_t end) {
    SiteLists lists;
    for (; i < end; ++i) lists.add_below(tree, points_of_cell(kind), nodes[i]);
    return lists;
  });
  std::vector<Site> in_leaves, in_coarser, all;
  for (const SiteLists& part : parts) {
    in_leaves.insert(in_leaves.end(), part.in_leaves.begin(), part.in_leaves.end());
    in_coarser.insert(in_coarser.end(), part.in_coarser.begin(), part.in_coarser.end());
  }
  sort_in_runs(
      in_coarser, [](auto first, auto last) { boost::sort::spreadsort::integer_sort(first, last); }, std::less<>());
  const auto repeated = std::ranges::unique(in_coarser);
  all.reserve(in_leaves.size() + in_coarser.size());
  std::set_union(in_leaves.begin(), in_leaves.end(), in_coarser.begin(), repeated.begin(), std::back_inserter(all));
  return all;
}

}  // namespace ccdt::lattice
