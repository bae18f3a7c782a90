#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/base/box.h"
#include "engine/geometry/box_tree.h"
#include "engine/lattice/domain_surface.h"
#include "engine/lattice/options.h"

namespace ccdt::lattice {

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
  BoxTree tetrahedra_, vertices_;
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
  BoxTree samples_;
  std::optional<InterpolatedSizes> interpolated_;
};

}  // namespace ccdt::lattice
