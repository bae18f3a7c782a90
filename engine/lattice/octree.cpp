#include "engine/lattice/octree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/errors.h"
#include "engine/lattice/cell_size.h"
#include "engine/lattice/sees_inside.h"

namespace ccdt {

namespace {

/// A leaf is split when its side is more than this times the target.
const double largest_excess = std::sqrt(2.0);

/// Places the root: a power of two times the reference cell, and on a multiple of that cell, around the surface.
Octree make_root(const Surface& surface, const SizeField& size, Lattice kind) {
  Octree tree;
  tree.bounds = bounding_box(surface.vertices);
  const auto extent = as_array(tree.bounds.high - tree.bounds.low);
  const double reach = *std::ranges::max_element(extent);
  // Half a cell, and half a box while a place is looked for, must be whole grid units: no cell below 2^4.
  constexpr int lowest_bit = 4;
  const double cell = std::max(round_to_few_bits(cell_side(kind, size.reference())), std::ldexp(1.0, lowest_bit + 8));
  double side = cell;
  // A cell of the reference size may be larger than the surface.
  while (side < reach + 2 * cell) side *= 2;
  int exponent = 0;
  std::frexp(side, &exponent);
  tree.depth = static_cast<unsigned>(std::min(static_cast<int>(Octree::bits) - 1, exponent - 8 - lowest_bit));
  tree.unit = std::ldexp(side, -static_cast<int>(tree.depth) - 1);
  const auto on_lattice = [cell](double x) { return cell * std::round(x / cell); };
  const Point3 centre = tree.bounds.center();
  tree.origin =
      Point3{on_lattice(centre.x), on_lattice(centre.y), on_lattice(centre.z)} - 0.5 * Point3{side, side, side};
  tree.nodes.emplace_back();
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) tree.triangles.push_back(t);
  tree.nodes[0].triangle_count = static_cast<std::uint32_t>(surface.triangles.size());
  if (surface.triangles.empty()) tree.nodes[0].place = NodePlace::outside;
  return tree;
}

class Builder {
 public:
  Builder(Octree& tree, const Surface& surface) : tree_(tree), surface_(surface), around_(surface.triangles.size()) {
    for (std::uint32_t t = 0; t < around_.size(); ++t) around_[t] = bounding_box(surface.corners(t));
  }

  void refine(const SizeField& size, Lattice kind) {
    // Children come after their parents, so one pass sees them all.
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      const OctreeNode& node = tree_.nodes[i];
      if (node.place == NodePlace::outside || node.level == tree_.depth) continue;
      const double edge_length = edge_length_of_cell(kind, tree_.length(tree_.side(node)));
      if (size.is_below(intersection(tree_.box(node), tree_.bounds), edge_length / largest_excess)) split(i);
    }
  }

  /// The neighbours of a split node must exist at its level: else a leaf would meet one that is two levels coarser.
  void balance() {
    std::vector<std::vector<std::uint32_t>> split_nodes(tree_.depth + 1);
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!tree_.nodes[i].is_leaf()) split_nodes[tree_.nodes[i].level].push_back(i);
    }
    for (unsigned level = tree_.depth; level > 0; --level) {
      for (std::uint32_t i : split_nodes[level]) {
        for (int neighbour = 0; neighbour < 27; ++neighbour) {
          const int step[] = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
          const OctreeNode& node = tree_.nodes[i];
          std::array<std::uint32_t, 3> corner;
          // Below 0 wraps around to a large number.
          for (int k = 0; k < 3; ++k)
            corner[k] = node.corner[k] + static_cast<std::uint32_t>(step[k]) * tree_.side(node);
          require(corner, level, split_nodes);
        }
      }
    }
  }

 private:
  /// Splits what is needed for a node with this corner to exist at the level.
  void require(const std::array<std::uint32_t, 3>& corner, unsigned level,
               std::vector<std::vector<std::uint32_t>>& split_nodes) {
    if (std::ranges::max(corner) >= tree_.side(tree_.nodes[0])) return;
    for (std::uint32_t i = 0; tree_.nodes[i].level < level;) {
      if (tree_.nodes[i].is_leaf()) {
        if (tree_.nodes[i].place == NodePlace::outside) return;
        split(i);
        split_nodes[tree_.nodes[i].level].push_back(i);
      }
      i = tree_.child_at(tree_.nodes[i], corner);
    }
  }

  void split(std::uint32_t parent_index) {
    constexpr std::size_t most_nodes = std::size_t{1} << 31;
    if (tree_.nodes.size() > most_nodes)
      throw LimitError("the octree of the interior points needs more than 2^31 nodes", {},
                       "ask for a greater edge length or a greater grading");
    const OctreeNode parent = tree_.nodes[parent_index];
    const auto first_child = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes[parent_index].first_child = first_child;
    const std::uint32_t half = tree_.side(parent) / 2;
    for (std::uint32_t c = 0; c < 8; ++c) {
      OctreeNode child;
      for (int k = 0; k < 3; ++k) child.corner[k] = parent.corner[k] + (c >> k & 1) * half;
      child.level = static_cast<std::uint8_t>(parent.level + 1);
      child.place = parent.place;
      tree_.nodes.push_back(child);
    }
    if (parent.place != NodePlace::surface) return;
    hand_down_triangles(parent, first_child);
    place_empty_children(parent, first_child);
  }

  void hand_down_triangles(const OctreeNode& parent, std::uint32_t first_child) {
    std::array<Box, 8> boxes;
    for (std::uint32_t c = 0; c < 8; ++c) {
      boxes[c] = tree_.box(tree_.nodes[first_child + c]);
      lists_[c].clear();
    }
    for (std::uint32_t t : tree_.triangles_of(parent)) hand_down(t, boxes);
    for (std::uint32_t c = 0; c < 8; ++c) {
      OctreeNode& child = tree_.nodes[first_child + c];
      child.first_triangle = static_cast<std::uint32_t>(tree_.triangles.size());
      child.triangle_count = static_cast<std::uint32_t>(lists_[c].size());
      tree_.triangles.insert(tree_.triangles.end(), lists_[c].begin(), lists_[c].end());
    }
  }

  /// Lists a triangle of the parent for each child that it may touch.
  void hand_down(std::uint32_t t, const std::array<Box, 8>& boxes) {
    const Box& around = around_[t];
    unsigned children = children_overlapping(boxes, around);
    std::optional<TouchingPlaces> places;
    for (; children != 0; children &= children - 1) {
      const auto c = static_cast<std::uint32_t>(std::countr_zero(children));
      if (!contains(boxes[c], around)) {
        if (!places) {
          const Point3 centre = boxes[0].high, side = boxes[0].high - boxes[0].low;
          double reach = 0;
          for (const Point3& corner : {around.low - centre, around.high - centre})
            for (const double x : as_array(corner)) reach = std::max(reach, std::abs(x));
          places.emplace(surface_.corners(t), 0.5 * side, reach + 0.5 * side.x);
        }
        if (!places->hold(boxes[c].center())) continue;
      }
      lists_[c].push_back(t);
    }
  }

  /// A bit for each child whose box overlaps another.
  static unsigned children_overlapping(const std::array<Box, 8>& boxes, const Box& other) {
    constexpr unsigned lower[] = {0x55, 0x33, 0x0F};
    const Box &first = boxes.front(), &last = boxes.back();
    const auto low = as_array(other.low), high = as_array(other.high);
    const auto first_low = as_array(first.low), first_high = as_array(first.high), last_low = as_array(last.low),
               last_high = as_array(last.high);
    unsigned children = 0xFF;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool in_lower = low[k] <= first_high[k] && high[k] >= first_low[k];
      const bool in_upper = low[k] <= last_high[k] && high[k] >= last_low[k];
      children &= (in_lower ? lower[k] : 0u) | (in_upper ? 0xFFu & ~lower[k] : 0u);
    }
    return children;
  }

  /// All empty children meet in the centre of the parent, so they are in the same place as the centre is.
  void place_empty_children(const OctreeNode& parent, std::uint32_t first_child) {
    std::uint32_t empty = 0, beyond_bounds = 0;
    for (std::uint32_t c = 0; c < 8; ++c) {
      const OctreeNode& child = tree_.nodes[first_child + c];
      if (child.triangle_count > 0) continue;
      ++empty;
      if (!contains(tree_.bounds, tree_.box(child))) ++beyond_bounds;
    }
    if (empty == 0) return;
    const bool inside = beyond_bounds == 0 && is_inside(tree_, surface_, tree_.box(parent).center(), parent);
    for (std::uint32_t c = 0; c < 8; ++c) {
      OctreeNode& child = tree_.nodes[first_child + c];
      if (child.triangle_count == 0) child.place = inside ? NodePlace::inside : NodePlace::outside;
    }
  }

  Octree& tree_;
  const Surface& surface_;
  std::vector<Box> around_;                          ///< by triangle
  std::array<std::vector<std::uint32_t>, 8> lists_;  ///< scratch of `hand_down_triangles`
};

}  // namespace

std::uint32_t Octree::child_at(const OctreeNode& node, const std::array<std::uint32_t, 3>& c) const {
  const std::uint32_t half = side(node) / 2;
  std::uint32_t child = node.first_child;
  for (unsigned k = 0; k < 3; ++k) child += (c[k] - node.corner[k] >= half ? 1u : 0u) << k;
  return child;
}

const OctreeNode& Octree::leaf_at(const std::array<std::uint32_t, 3>& c) const {
  std::uint32_t i = 0;
  while (!nodes[i].is_leaf()) i = child_at(nodes[i], c);
  return nodes[i];
}

bool is_inside(const Octree& tree, const Surface& surface, const Point3& p, const OctreeNode& node) {
  const auto answer_in = [&](const OctreeNode& n) {
    return sees_inside(p, intersection(tree.box(n), tree.bounds), surface, tree.triangles_of(n));
  };
  if (const auto answer = answer_in(node)) return *answer;
  // Triangles are handed down with a margin, so none may be in the box itself. The boxes around it have more.
  std::vector<std::uint32_t> path = {0};
  while (tree.nodes[path.back()].level < node.level)
    path.push_back(tree.child_at(tree.nodes[path.back()], node.corner));
  for (; !path.empty(); path.pop_back()) {
    if (const auto answer = answer_in(tree.nodes[path.back()])) return *answer;
  }
  return false;
}

Octree build_octree(const Surface& surface, const SizeField& size, Lattice kind) {
  Octree tree = make_root(surface, size, kind);
  Builder builder(tree, surface);
  builder.refine(size, kind);
  builder.balance();
  return tree;
}

}  // namespace ccdt
