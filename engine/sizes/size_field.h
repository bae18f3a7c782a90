#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "engine/base/box.h"
#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/sizes/interpolated_sizes.h"

namespace ccdt::sizes {

/// A place in space and the edge length wanted there.
struct SizedPlace {
  Box box;
  double size;
};

/// The target edge length in space: what lattices, refinement and remeshing ask for.
class SizeField {
 public:
  /// The least of `largest`, over some places (size + grading * distance) and, if there is a background, its sizes.
  ///
  /// \param background  must outlive this; linear within its tetrahedra. If it has none, its vertices are such places
  ///                    too. Null or empty: none
  SizeField(double largest, double grading, std::span<const SizedPlace> places,
            const BackgroundSizes* background = nullptr);

  /// The target is nowhere above this; may be infinite.
  double largest() const { return largest_; }
  /// The target grows by at most this per unit of distance; infinite if it has sizes of a mesh.
  double grading() const { return interpolated_ ? HUGE_VAL : grading_; }

  /// Is the target below `bound` anywhere in the box?
  bool is_below(const Box& box, double bound) const;

  /// The target at a point.
  ///
  /// \param bound  an upper bound of the target; the tighter, the faster
  double at(const Point3& p, double bound) const;
  double at(const Point3& p) const { return at(p, largest_); }

 private:
  double largest_ = 0, grading_ = 0;
  BoxTree places_;
  std::optional<InterpolatedSizes> interpolated_;
};

/// Asks a field for its targets at points. It is faster if most points are near the one before.
class SizeWalk {
 public:
  /// \param field  must outlive this
  explicit SizeWalk(const SizeField& field) : field_(field), last_size_(field.largest()) {}

  double at(const Point3& p) {
    // The target grows at most with the grading, so the last one bounds this one, up to rounding.
    const double moved = length(p - last_), growth = moved > 0 ? field_.grading() * moved : 0;
    const double bound = (1 + 1e-12) * (last_size_ + growth);
    last_size_ = field_.at(p, bound), last_ = p;
    return last_size_;
  }

 private:
  const SizeField& field_;
  Point3 last_;  ///< where the target was asked for last, and what it was
  double last_size_;
};

}  // namespace ccdt::sizes
