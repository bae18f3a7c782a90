#pragma once

#include "engine/lattice/options.h"
#include "engine/lattice/size_tree.h"

namespace ccdt {

/// Sizes that are given at the vertices of a tetrahedral mesh. Within a tetrahedron they are linear; outside of all, a
/// point has the size of the nearest vertex.
class InterpolatedSizes {
 public:
  /// \param background  must outlive this
  explicit InterpolatedSizes(const BackgroundSizes& background);

  /// Is the size below `bound` anywhere in the box? Of a box that is only partly in the mesh, that part is asked.
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

}  // namespace ccdt
