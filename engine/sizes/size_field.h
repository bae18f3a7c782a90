#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/count_work.h"
#include "engine/base/raw_vector.h"
#include "engine/lattice/domain_surface.h"
#include "engine/lattice/options.h"

namespace ccdt::lattice {

/// Things in space that have a size. In Morton order they are the leaves of a complete binary tree of boxes. The tree
/// is an array: the children of group g are 2g+1 and 2g+2.
class SizeTree {
 public:
  struct Item {
    Box box;
    double size;
    std::uint32_t number;  ///< the caller's
  };

  SizeTree() = default;
  explicit SizeTree(std::span<const Item> items);

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

  RawVector<Item> items_;
  RawVector<Group> groups_;
  std::size_t first_leaf_ = 0;
};

/// Sizes that are given at the vertices of a tetrahedral mesh. Within a tetrahedron they are linear; outside of all, a
/// point has the size of the nearest vertex.
class InterpolatedSizes {
 public:
  /// \param background  must outlive this
  explicit InterpolatedSizes(const BackgroundSizes& background);

  /// Is the size below `bound` anywhere in the box? Only the part of the box inside the mesh counts, if there is one.
  bool is_below(const Box& box, double bound) const;

 private:
  double least_in(const Box& box, std::uint32_t tetrahedron) const;
  bool is_below_outside(const Box& box, double bound) const;

  const BackgroundSizes& background_;
  SizeTree tetrahedra_, vertices_;
};

/// The least value within both a tetrahedron and a box of the linear function that has the given values at the corners;
/// infinite if the two do not meet, or if the tetrahedron is flat. Up to rounding.
double least_value(const std::array<Point3, 4>& corners, const std::array<double, 4>& values, const Box& box);

/// The target edge length in space, at most `largest()`.
///
/// Without a background: the least over the surface of (edge length there + grading * distance). The surface is sampled
/// at its vertices (mean length of the edges there) and the centroids of its triangles (mean of their edges). With a
/// background of vertices alone: the least over these of (size + grading * distance). With a background mesh: linear
/// within its tetrahedra (`InterpolatedSizes`).
class SizeField {
 public:
  /// In grid units. Without a background a grading of 0 means uniform.
  /// \param background  must outlive this; null or empty: none
  SizeField(const DomainSurface& surface, double edge_length, double grading,
            const BackgroundSizes* background = nullptr);

  /// The edge length of most of the mesh: that of the user, or the mean of the surface, or the median of the background
  /// (weighted by the points of a mesh of these sizes).
  double reference() const { return reference_; }
  /// The target is nowhere above this; may be infinite.
  double largest() const { return largest_; }

  /// Is the target edge length below `bound` anywhere in the box?
  bool is_below(const Box& box, double bound) const;

 private:
  void sample(const DomainSurface& surface, double edge_length);
  void sample(const BackgroundSizes& background, double edge_length);

  double reference_ = 0, largest_ = 0, grading_ = 0;
  SizeTree samples_;
  std::optional<InterpolatedSizes> interpolated_;
};

}  // namespace ccdt::lattice
