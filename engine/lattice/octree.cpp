#include "engine/lattice/octree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/count_work.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/filters.h"
#include "engine/lattice/inside_test.h"

namespace ccdt::lattice {

namespace {

constexpr double sixth_root_of_two = 1.12246204830937298;

/// side / edge_length, see the table in the header.
double side_for_unit_edge(Lattice kind) {
  switch (kind) {
    case Lattice::bcc:
      return sixth_root_of_two;
    case Lattice::sc:
      return 1 / sixth_root_of_two;
    case Lattice::fcc:
    case Lattice::none:
    case Lattice::refinement:
      break;
  }
  return std::sqrt(2.0);
}

/// The children of a node on the upper sides of its three middle planes, as bits.
constexpr unsigned upper_children[] = {0xAA, 0xCC, 0xF0};

/// A bit for each child of a node, set unless the child and the triangle are certainly apart. Their bounding boxes may
/// overlap. Tests separating axes, with a margin for rounding: the cross products of edges and axes here (in three
/// lanes, one for each edge), the triangle's normal below.
///
/// \param center  of the node
/// \param half    of the sides of its children
/// \param reach   bound on the coordinates of corners relative to the centers of all children
CCDT_ALWAYS_INLINE unsigned children_touching(const TrianglePoints& triangle, const Point3& center, double half,
                                              double reach) {
  const auto ab = as_array(triangle[1] - triangle[0]), bc = as_array(triangle[2] - triangle[1]),
             ac = as_array(triangle[2] - triangle[0]), to_center = as_array(center - triangle[0]);
  // The boxes grow by a margin, so that rounding can only turn "apart" into "touching".
  const double size = half * (1 + 1e-9) + 1e-12 * reach;
  Lanes edge[3] = {}, magnitude[3] = {};
  for (int k = 0; k < 3; ++k) {
    edge[k] = Lanes{ab[k], bc[k], ac[k], 0};
    filter::magnitude(edge[k], magnitude[k]);
  }
  IntegerLanes apart = {};  // in each lane: the children that this edge shows to be apart
  for (int k = 0; k < 3; ++k) {
    const int p = (k + 1) % 3, q = (k + 2) % 3;
    // Of the corners, along the axes; the first corner is at 0.
    const Lanes b = edge[p] * ab[q] - edge[q] * ab[p], c = edge[p] * ac[q] - edge[q] * ac[p];
    const Lanes radius = size * (magnitude[p] + magnitude[q]), none = {};
    Lanes low, high;
    low = b < c ? b : c, high = b > c ? b : c;
    low = (low < none ? low : none) - radius, high = (high > none ? high : none) + radius;
    for (unsigned side = 0; side < 4; ++side) {
      const double at_p = to_center[p] + ((side & 1) != 0 ? half : -half),
                   at_q = to_center[q] + ((side & 2) != 0 ? half : -half);
      const std::int64_t children = ((side & 1) != 0 ? upper_children[p] : 0xFF & ~upper_children[p]) &
                                    ((side & 2) != 0 ? upper_children[q] : 0xFF & ~upper_children[q]);
      const Lanes along = edge[p] * at_q - edge[q] * at_p;
      apart |= ((along < low) | (along > high)) & children;
    }
  }
  auto touching = static_cast<unsigned>(0xFF & ~(apart[0] | apart[1] | apart[2]));
  const Point3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  double longest = 0;
  for (const Lanes& lanes : magnitude) longest = std::max({longest, lanes[0], lanes[1], lanes[2]});
  const double radius =
      size * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) + 1e-14 * longest * longest * reach;
  for (unsigned c = 0; c < 8; ++c) {
    const double along = normal.x * (to_center[0] + ((c & 1) != 0 ? half : -half)) +
                         normal.y * (to_center[1] + ((c & 2) != 0 ? half : -half)) +
                         normal.z * (to_center[2] + ((c & 4) != 0 ? half : -half));
    touching &= ~(unsigned{std::abs(along) > radius} << c);
  }
  return touching;
}

/// A leaf is split when its side is more than this times the target.
const double largest_excess = std::sqrt(2.0);

/// Places the root: a power of two times the reference cell, and on a multiple of that cell, around the surface.
Octree make_root(const DomainSurface& surface, const TargetSizes& size, Lattice kind) {
  Octree tree;
  tree.bounds = bounding_box(surface.vertices);
  const auto extent = as_array(tree.bounds.high - tree.bounds.low);
  const double reach = *std::ranges::max_element(extent);
  // Half a cell, and half a box during a search, must be whole grid units: no cell is below 2^4.
  constexpr int lowest_bit = 4;
  const double cell = std::max(round_to_few_bits(cell_side(kind, size.reference)), std::ldexp(1.0, lowest_bit + 8));
  double side = cell;
  // A cell of the reference size may be larger than the surface.
  while (side < reach + 2 * cell) side *= 2;
  int exponent = 0;
  std::frexp(side, &exponent);
  tree.depth = static_cast<unsigned>(std::min(static_cast<int>(Octree::bits) - 1, exponent - 8 - lowest_bit));
  tree.unit = std::ldexp(side, -static_cast<int>(tree.depth) - 1);
  const auto on_lattice = [cell](double x) { return cell * std::round(x / cell); };
  const Point3 center = tree.bounds.center();
  tree.origin =
      Point3{on_lattice(center.x), on_lattice(center.y), on_lattice(center.z)} - 0.5 * Point3{side, side, side};
  tree.nodes.push_back({});
  tree.triangles.resize(surface.triangles.size());
  std::iota(tree.triangles.begin(), tree.triangles.end(), 0u);
  tree.nodes[0].triangle_count = static_cast<std::uint32_t>(surface.triangles.size());
  if (surface.triangles.empty()) tree.nodes[0].place = NodePlace::outside;
  return tree;
}

class Builder {
 public:
  Builder(Octree& tree, const DomainSurface& surface)
      : tree_(tree), surface_(surface), around_(surface.triangles.size()) {
    parallel_for(around_.size(), 4096,
                 [&](std::size_t t) { around_[t] = bounding_box(surface.corners(static_cast<std::uint32_t>(t))); });
  }

  void refine(const TargetSizes& size, Lattice kind) {
    // Children come after their parents, level by level.
    for (std::size_t begin = 0, end = 1; begin < end; begin = end, end = tree_.nodes.size()) {
      std::vector<std::uint8_t> is_too_large(end - begin);
      parallel_for(is_too_large.size(), 64, [&](std::size_t i) {
        const OctreeNode& node = tree_.nodes[begin + i];
        if (node.place == NodePlace::outside || node.level == tree_.depth) return;
        const double edge_length = edge_length_of_cell(kind, tree_.length(tree_.side(node)));
        is_too_large[i] =
            size.field.is_below(intersection(tree_.box(node), tree_.bounds), edge_length / largest_excess);
      });
      std::vector<std::uint32_t> parents;
      for (std::size_t i = 0; i < is_too_large.size(); ++i)
        if (is_too_large[i]) parents.push_back(static_cast<std::uint32_t>(begin + i));
      split(parents);
    }
  }

  /// The neighbors of a split node must exist at its level; otherwise a leaf would meet one that is two levels coarser.
  void balance() {
    std::vector<Nodes> split_nodes(tree_.depth + 1);
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!tree_.nodes[i].is_leaf()) split_nodes[tree_.nodes[i].level].push_back(i);
    }
    for (unsigned level = tree_.depth; level > 0; --level) {
      // From here on, only coarser nodes are split, by one thread. Several threads first look for the nodes that
      // require splits.
      Nodes nodes = std::move(split_nodes[level]);
      if (thread_count() > 1) nodes = without_all_neighbors(nodes, level);
      for (const std::uint32_t i : nodes)
        for (int neighbor = 0; neighbor < 27; ++neighbor)
          require(corner_of_neighbor(tree_.nodes[i], neighbor), level, split_nodes);
    }
  }

 private:
  using Nodes = std::vector<std::uint32_t>;

  /// \param neighbor  0 .. 26, x first; 13 is the node itself
  std::array<std::uint32_t, 3> corner_of_neighbor(const OctreeNode& node, int neighbor) const {
    const int step[] = {neighbor % 3 - 1, neighbor / 3 % 3 - 1, neighbor / 9 - 1};
    std::array<std::uint32_t, 3> corner;
    // Below 0 wraps around to a large number.
    for (int k = 0; k < 3; ++k) corner[k] = node.corner[k] + static_cast<std::uint32_t>(step[k]) * tree_.side(node);
    return corner;
  }

  /// The nodes of a level that are next to a leaf that must be split, in the same order.
  Nodes without_all_neighbors(const Nodes& nodes, unsigned level) const {
    return parallel_collect<std::uint32_t>(nodes.size(), 256, [&](std::size_t i, std::size_t end, Nodes& found) {
      for (; i < end; ++i) {
        int neighbor = 0;
        while (neighbor < 27 && exists(corner_of_neighbor(tree_.nodes[nodes[i]], neighbor), level)) ++neighbor;
        if (neighbor < 27) found.push_back(nodes[i]);
      }
    });
  }

  /// Does a node with this corner exist at the level, or is none needed?
  bool exists(const std::array<std::uint32_t, 3>& corner, unsigned level) const {
    if (std::ranges::max(corner) >= tree_.side(tree_.nodes[0])) return true;
    std::uint32_t i = 0;
    while (tree_.nodes[i].level < level && !tree_.nodes[i].is_leaf()) i = tree_.child_at(tree_.nodes[i], corner);
    return tree_.nodes[i].level >= level || tree_.nodes[i].place == NodePlace::outside;
  }

  /// Splits nodes until one with this corner exists at the level.
  void require(const std::array<std::uint32_t, 3>& corner, unsigned level, std::vector<Nodes>& split_nodes) {
    if (std::ranges::max(corner) >= tree_.side(tree_.nodes[0])) return;
    for (std::uint32_t i = 0; tree_.nodes[i].level < level;) {
      if (tree_.nodes[i].is_leaf()) {
        if (tree_.nodes[i].place == NodePlace::outside) return;
        split({&i, 1});
        split_nodes[tree_.nodes[i].level].push_back(i);
      }
      i = tree_.child_at(tree_.nodes[i], corner);
    }
  }

  using Triangles = RawVector<std::uint32_t>;

  /// Splits nodes. Their children come in the same order.
  void split(std::span<const std::uint32_t> parents) {
    const std::uint32_t first = make_room(parents.size());
    const std::size_t length = std::clamp<std::size_t>(parents.size() / 64, 1, 64);
    if (thread_count() == 1 || parents.size() <= length) {
      split_run(parents, first, tree_.triangles, lists_);
      return;
    }
    const auto runs = parallel_chunks(parents.size(), length, [&](std::size_t begin, std::size_t end) {
      Triangles triangles;
      std::array<Triangles, 8> lists;
      split_run(parents.subspan(begin, end - begin), first + static_cast<std::uint32_t>(8 * begin), triangles, lists);
      return triangles;
    });
    std::vector<std::size_t> places;
    std::size_t size = tree_.triangles.size();
    for (const Triangles& triangles : runs) places.push_back(std::exchange(size, size + triangles.size()));
    tree_.triangles.resize(size);
    parallel_for(runs.size(), 1, [&](std::size_t r) {
      const std::size_t begin = first + 8 * length * r, end = std::min(begin + 8 * length, tree_.nodes.size());
      for (std::size_t i = begin; i < end; ++i) tree_.nodes[i].first_triangle += static_cast<std::uint32_t>(places[r]);
      std::ranges::copy(runs[r], tree_.triangles.begin() + static_cast<std::ptrdiff_t>(places[r]));
    });
  }

  /// \return  where the children of this many nodes begin
  std::uint32_t make_room(std::size_t parents) {
    constexpr std::size_t most_nodes = std::size_t{1} << 31;
    const std::size_t first = tree_.nodes.size();
    if (first + 8 * parents > most_nodes + 8)
      throw LimitError(
          "the edge length is too short: the octree of the interior points would need more than 2^31 nodes", {},
          "give a longer --edge-length or a greater --grading");
    tree_.nodes.resize(first + 8 * parents);
    return static_cast<std::uint32_t>(first);
  }

  /// \param triangles  gets the triangles of the children
  /// \param lists      working memory
  void split_run(std::span<const std::uint32_t> parents, std::uint32_t first_child, Triangles& triangles,
                 std::array<Triangles, 8>& lists) {
    for (const std::uint32_t parent : parents) {
      split(parent, first_child, triangles, lists);
      first_child += 8;
    }
  }

  void split(std::uint32_t parent_index, std::uint32_t first_child, Triangles& triangles,
             std::array<Triangles, 8>& lists) {
    const OctreeNode parent = tree_.nodes[parent_index];
    tree_.nodes[parent_index].first_child = first_child;
    const std::uint32_t half = tree_.side(parent) / 2;
    for (std::uint32_t c = 0; c < 8; ++c) {
      OctreeNode& child = tree_.nodes[first_child + c] = {};
      for (int k = 0; k < 3; ++k) child.corner[k] = parent.corner[k] + (c >> k & 1) * half;
      child.level = static_cast<std::uint8_t>(parent.level + 1);
      child.place = parent.place;
    }
    if (parent.place != NodePlace::surface) return;
    hand_down_triangles(parent, first_child, triangles, lists);
    place_empty_children(parent, first_child);
  }

  void hand_down_triangles(const OctreeNode& parent, std::uint32_t first_child, Triangles& triangles,
                           std::array<Triangles, 8>& lists) {
    std::array<Box, 8> boxes;
    for (std::uint32_t c = 0; c < 8; ++c) {
      boxes[c] = tree_.box(tree_.nodes[first_child + c]);
      lists[c].clear();
    }
    const std::span<const std::uint32_t> those = tree_.triangles_of(parent);
    // The first nodes have too many triangles for one thread.
    constexpr std::size_t length = 8192;
    if (thread_count() > 1 && those.size() > length) {
      const auto runs = parallel_chunks(those.size(), length, [&](std::size_t begin, std::size_t end) {
        std::array<Triangles, 8> found;
        hand_down(those.subspan(begin, end - begin), boxes, found);
        return found;
      });
      for (const std::array<Triangles, 8>& found : runs)
        for (std::uint32_t c = 0; c < 8; ++c) lists[c].insert(lists[c].end(), found[c].begin(), found[c].end());
    } else {
      hand_down(those, boxes, lists);
    }
    for (std::uint32_t c = 0; c < 8; ++c) {
      OctreeNode& child = tree_.nodes[first_child + c];
      child.first_triangle = static_cast<std::uint32_t>(triangles.size());
      child.triangle_count = static_cast<std::uint32_t>(lists[c].size());
      triangles.insert(triangles.end(), lists[c].begin(), lists[c].end());
    }
  }

  /// Lists triangles of the parent for each child that they may touch.
  CCDT_WIDE_LANES void hand_down(std::span<const std::uint32_t> those, const std::array<Box, 8>& boxes,
                                 std::array<Triangles, 8>& lists) const {
    for (const std::uint32_t t : those) {
      unsigned children = children_overlapping(boxes, around_[t]);
      // A triangle whose box is in one child touches that child alone.
      if (!std::has_single_bit(children) || !contains(boxes[std::countr_zero(children)], around_[t]))
        children &= children_touching(t, boxes);
      for (; children != 0; children &= children - 1) lists[std::countr_zero(children)].push_back(t);
    }
  }

  CCDT_ALWAYS_INLINE unsigned children_touching(std::uint32_t t, const std::array<Box, 8>& boxes) const {
    const Point3 center = boxes[0].high;
    const double half = 0.5 * (boxes[0].high.x - boxes[0].low.x);
    double reach = 0;
    for (const Point3& corner : {around_[t].low - center, around_[t].high - center})
      for (const double x : as_array(corner)) reach = std::max(reach, std::abs(x));
    return lattice::children_touching(surface_.corners(t), center, half, reach + half);
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

  /// All empty children share the center of the parent, so they have the same `NodePlace` as the center.
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
  const DomainSurface& surface_;
  RawVector<Box> around_;           ///< by triangle
  std::array<Triangles, 8> lists_;  ///< working memory
};

}  // namespace

double cell_side(Lattice kind, double edge_length) {
  return edge_length * side_for_unit_edge(kind);
}

double edge_length_of_cell(Lattice kind, double side) {
  return side / side_for_unit_edge(kind);
}

double round_to_few_bits(double positive) {
  constexpr int significant_bits = 8;
  int exponent = 0;
  const double fraction = std::frexp(positive, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, significant_bits)), exponent - significant_bits);
}

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

const OctreeNode& Octree::leaf_with(const Point3& p) const {
  const auto from_origin = as_array(p - origin);
  std::array<std::uint32_t, 3> c;
  for (std::size_t k = 0; k < 3; ++k) {
    c[k] = static_cast<std::uint32_t>(from_origin[k] / unit);
    if (length(c[k]) > from_origin[k]) --c[k];  // the quotient was rounded up
  }
  return leaf_at(c);
}

bool is_inside(const Octree& tree, const DomainSurface& surface, const Point3& p, const OctreeNode& node) {
  const auto answer_in = [&](const OctreeNode& n) {
    return is_inside_by_rays(p, intersection(tree.box(n), tree.bounds), surface, tree.triangles_of(n));
  };
  if (const auto answer = answer_in(node)) return *answer;
  // Triangles are passed down with a margin, so the box itself may contain none. The larger boxes around it contain
  // more.
  std::vector<std::uint32_t> path = {0};
  while (tree.nodes[path.back()].level < node.level)
    path.push_back(tree.child_at(tree.nodes[path.back()], node.corner));
  for (; !path.empty(); path.pop_back()) {
    if (const auto answer = answer_in(tree.nodes[path.back()])) return *answer;
  }
  return false;
}

Octree build_octree(const DomainSurface& surface, const TargetSizes& size, Lattice kind) {
  Octree tree = make_root(surface, size, kind);
  Builder builder(tree, surface);
  builder.refine(size, kind);
  builder.balance();
  work_done.octree_nodes_created += tree.nodes.size();
  note_bytes(bytes_of(tree.nodes, tree.triangles));
  return tree;
}

}  // namespace ccdt::lattice
