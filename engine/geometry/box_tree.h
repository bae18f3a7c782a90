#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace ccdt {

/// A hierarchy of bounding boxes: the items in Morton order of their centers, halved repeatedly.
///
///     node 1 = [2 3], node i = [2i 2i+1], the last `leaf_count` nodes are runs of `leaf_size` items
class BoxTree {
 public:
  struct Item {
    std::uint32_t number;  ///< of its box in the list
    const Box& box;
    double size;  ///< 0 without sizes
  };

  BoxTree() = default;
  /// \param sizes  of the items, if they have any
  explicit BoxTree(RawVector<Box> boxes, const RawVector<double>& sizes = {});
  /// Over a list of anything, which several threads read.
  ///
  /// \param box_of   `box_of(items[i])` is the box of item i
  /// \param size_of  the same for its size
  template <class Items, class BoxOf>
  BoxTree(const Items& items, const BoxOf& box_of) : BoxTree(values_of(items, box_of)) {}
  template <class Items, class BoxOf, class SizeOf>
  BoxTree(const Items& items, const BoxOf& box_of, const SizeOf& size_of)
      : BoxTree(values_of(items, box_of), values_of(items, size_of)) {}

  std::size_t bytes() const { return bytes_of(items_, boxes_, nodes_, sizes_, least_sizes_, places_); }

  /// Puts the item into this box as well, from now on.
  void enlarge(std::uint32_t item, const Box& box);

  /// Calls visit(item) for all items whose box meets the given box or line segment.
  template <class Shape, class Visit>
  void for_each_meeting(const Shape& shape, Visit&& visit) const {
    if (!items_.empty() && nodes_[1].meets(shape)) descend(1, shape, visit);
  }

  /// Calls holds(item) until it returns true, for the items whose `lower(box, size)` is below the bound. `holds` may
  /// lower the bound. Boxes with a small lower bound come first. \return did a call?
  ///
  /// \param lower  lower(box, size) is a lower bound for all items in the box of at least this size
  template <class Lower, class Holds>
  bool any_below(const double& bound, const Lower& lower, const Holds& holds) const;

  /// Calls visit(i, j) once for every pair of different items whose boxes meet.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (std::size_t place = 0; place < items_.size(); ++place)
      for_each_meeting(boxes_[place], [&, i = items_[place]](std::uint32_t j) {
        if (i < j) visit(i, j);
      });
  }

 private:
  static constexpr std::uint32_t leaf_size = 4;

  template <class Items, class ValueOf>
  static auto values_of(const Items& items, const ValueOf& value_of) {
    RawVector<decltype(value_of(items[0]))> values(items.size());
    parallel_for(values.size(), 4096, [&](std::size_t i) { values[i] = value_of(items[i]); });
    return values;
  }

  bool is_leaf(std::uint32_t node) const { return node >= leaf_count_; }
  /// Where the items of a leaf begin and end in `items_`.
  std::array<std::size_t, 2> places_of(std::uint32_t leaf) const {
    const std::size_t begin = std::min<std::size_t>(std::size_t{leaf - leaf_count_} * leaf_size, items_.size());
    return {begin, std::min<std::size_t>(begin + leaf_size, items_.size())};
  }

  template <class Shape, class Visit>
  void descend(std::uint32_t node, const Shape& shape, Visit& visit) const {
    ++work_done.box_tree_nodes;
    if (!is_leaf(node)) {
      for (const std::uint32_t child : {2 * node, 2 * node + 1})
        if (nodes_[child].meets(shape)) descend(child, shape, visit);
      return;
    }
    const auto [begin, end] = places_of(node);
    for (std::size_t i = begin; i < end; ++i)
      if (boxes_[i].meets(shape)) {
        ++work_done.box_pairs;
        visit(items_[i]);
      }
  }

  /// A node that is not visited yet.
  struct Visit {
    std::uint32_t node;
    double lower;
  };
  Item item_at(std::size_t place) const { return {items_[place], boxes_[place], sizes_.empty() ? 0 : sizes_[place]}; }
  template <class Lower>
  Visit look_at(std::uint32_t node, const Lower& lower) const {
    return {node, is_empty(nodes_[node]) ? HUGE_VAL : lower(nodes_[node], sizes_.empty() ? 0 : least_sizes_[node])};
  }

  std::vector<std::uint32_t> items_;   // in Morton order
  RawVector<Box> boxes_;               // of these
  RawVector<Box> nodes_;               // from 1 on
  RawVector<double> sizes_;            // like boxes_; empty without sizes
  RawVector<double> least_sizes_;      // like nodes_
  std::vector<std::uint32_t> places_;  // of the items; empty until one is enlarged
  std::uint32_t leaf_count_ = 1;       // a power of two
};

template <class Lower, class Holds>
bool BoxTree::any_below(const double& bound, const Lower& lower, const Holds& holds) const {
  if (items_.empty()) return false;
  std::array<Visit, 64> stack;  // at most two for each level of the tree
  std::size_t height = 0;
  stack[height++] = look_at(1, lower);
  while (height > 0) {
    const auto [node, its_lower] = stack[--height];
    if (its_lower >= bound) continue;  // it may have been lowered
    ++work_done.box_tree_nodes;
    if (is_leaf(node)) {
      const auto [begin, end] = places_of(node);
      for (std::size_t i = begin; i < end; ++i)
        if (const Item item = item_at(i); lower(item.box, item.size) < bound && holds(item)) return true;
      continue;
    }
    Visit near = look_at(2 * node, lower), far = look_at(2 * node + 1, lower);
    if (far.lower < near.lower) std::swap(near, far);
    if (far.lower < bound) stack[height++] = far;
    if (near.lower < bound) stack[height++] = near;
  }
  return false;
}

}  // namespace ccdt
