#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/count_work.h"
#include "engine/base/raw_vector.h"

namespace ccdt::sizes {

/// A place in space and the edge length that is wanted there.
struct SizedPlace {
  Box box;
  double size;
  std::uint32_t number = 0;  ///< the caller's
};

/// Places in Morton order: the leaves of a complete binary tree of boxes. The tree is an array: the children of group g
/// are 2g+1 and 2g+2.
class SizeTree {
 public:
  SizeTree() = default;
  explicit SizeTree(std::span<const SizedPlace> places);

  /// Is `holds(item)` true for any item? Tests only those whose `lower(box, size)` is below the bound, which `holds`
  /// may lower.
  ///
  /// \param lower  lower(box, size) is a lower bound for all items in the box of at least this size
  template <class Lower, class Holds>
  bool any(const double& bound, const Lower& lower, const Holds& holds) const {
    if (items_.empty() || lower(groups_[0].box, groups_[0].size) >= bound) return false;
    std::array<Visit, 64> stack;  // at most two per level of the tree
    std::size_t height = 0;
    stack[height++] = {0, 0, items_.size(), lower(groups_[0].box, groups_[0].size)};
    while (height > 0) {
      const Visit visit = stack[--height];
      ++work_done.box_tree_nodes;
      if (visit.lower >= bound) continue;  // it may have been lowered
      if (visit.group >= first_leaf_) {
        for (std::size_t i = visit.begin; i < visit.end; ++i)
          if (lower(items_[i].box, items_[i].size) < bound && holds(items_[i])) return true;
        continue;
      }
      const std::size_t left = 2 * visit.group + 1, half = middle(visit.begin, visit.end);
      Visit near{left, visit.begin, half, lower(groups_[left].box, groups_[left].size)};
      Visit far{left + 1, half, visit.end, lower(groups_[left + 1].box, groups_[left + 1].size)};
      if (far.lower < near.lower) std::swap(near, far);
      if (far.lower < bound) stack[height++] = far;
      if (near.lower < bound) stack[height++] = near;
    }
    return false;
  }

 private:
  struct Group {
    Box box;
    double size;  ///< the least
  };
  struct Visit {
    std::size_t group, begin, end;
    double lower;
  };

  /// Where half of the items [begin, end) go to the first child: the same rule must hold for boxes and queries.
  static std::size_t middle(std::size_t begin, std::size_t end) { return begin + (end - begin) / 2; }
  static Group both(const Group& a, const Box& box, double size);
  Group surround(std::size_t begin, std::size_t end, std::size_t group);

  RawVector<SizedPlace> items_;
  RawVector<Group> groups_;
  std::size_t first_leaf_ = 0;
};

}  // namespace ccdt::sizes
