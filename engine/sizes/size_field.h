#pragma once

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
  /// The least of `largest` and, over some places, (size + grading * distance).
  SizeField(double largest, double grading, std::span<const SizedPlace> places);
  /// The least of `largest` and the sizes of a mesh, which are linear within its tetrahedra.
  ///
  /// \param background  has tetrahedra; must outlive this
  SizeField(double largest, const BackgroundSizes& background);

  /// The target is nowhere above this; may be infinite.
  double largest() const { return largest_; }
  double grading() const { return grading_; }

  /// Is the target below `bound` anywhere in the box?
  bool is_below(const Box& box, double bound) const;

  /// The target at a point; only for a field of places.
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
    const double bound = (1 + 1e-12) * (last_size_ + field_.grading() * length(p - last_));
    last_size_ = field_.at(p, bound), last_ = p;
    return last_size_;
  }

 private:
  const SizeField& field_;
  Point3 last_;  ///< where the target was asked for last, and what it was
  double last_size_;
};

}  // namespace ccdt::sizes
