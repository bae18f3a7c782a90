#pragma once

#include <array>
#include <cstdint>

#include "engine/base/box.h"
#include "engine/geometry/box_tree.h"
#include "engine/sizes/background_sizes.h"

namespace ccdt::sizes {

/// \throw InputError  a vertex is not finite, has no size or one that is not positive, or a corner is no vertex
void check_background(const BackgroundSizes& background);

/// Sizes that are given at the vertices of a tetrahedral mesh. Within a tetrahedron they are linear; outside of all
/// tetrahedra, a point has the size of the nearest vertex.
class InterpolatedSizes {
 public:
  /// \param background  must outlive this
  explicit InterpolatedSizes(const BackgroundSizes& background);

  /// Is the size below `bound` anywhere in the box? Only the part of the box inside the mesh counts, if there is one.
  bool is_below(const Box& box, double bound) const;

  /// The size at a point; the least one if tetrahedra overlap there.
  double at(const Point3& p) const;

 private:
  double least_in(const Box& box, std::uint32_t tetrahedron) const;
  bool is_below_outside(const Box& box, double bound) const;

  const BackgroundSizes* background_;
  BoxTree tetrahedra_, vertices_;
};

/// The least value, within both a tetrahedron and a box, of the linear function with these values at the corners;
/// infinite if the two do not meet, or if the tetrahedron is flat. Up to rounding.
double least_value(const std::array<Point3, 4>& corners, const std::array<double, 4>& values, const Box& box);

}  // namespace ccdt::sizes
