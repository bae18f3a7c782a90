#pragma once

#include <optional>

#include "engine/lattice/interpolated_sizes.h"
#include "engine/lattice/size_tree.h"
#include "engine/lattice/surface.h"

namespace ccdt {

/// The target edge length in space, at most `largest()`.
///
/// Without a background: the least over the surface of (edge length there + grading * distance). The surface is sampled
/// at its vertices (mean length of the edges there) and the centroids of its triangles (mean of their edges). With a
/// background of vertices alone: the least over these of (size + grading * distance). With a background mesh: linear
/// within its tetrahedra (interpolated_sizes.h).
class SizeField {
 public:
  /// In grid units. Without a background a grading of 0 means uniform.
  /// \param background  must outlive this; null or empty: none
  SizeField(const Surface& surface, double edge_length, double grading, const BackgroundSizes* background = nullptr);

  /// The edge length that most of the mesh should have: as the user gave it, or the mean of the surface, or the median
  /// of the background (of as many points as a mesh of these sizes has).
  double reference() const { return reference_; }
  /// The target is nowhere above this; may be infinite.
  double largest() const { return largest_; }

  /// Is the target edge length below `bound` anywhere in the box?
  bool is_below(const Box& box, double bound) const;

 private:
  void sample(const Surface& surface, double edge_length);
  void sample(const BackgroundSizes& background, double edge_length);

  double reference_ = 0, largest_ = 0, grading_ = 0;
  SizeTree samples_;
  std::optional<InterpolatedSizes> interpolated_;
};

}  // namespace ccdt
