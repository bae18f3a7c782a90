#pragma once

#include <optional>

#include "engine/base/point.h"
#include "engine/lattice/size_field.h"
#include "engine/plc/plc.h"

namespace ccdt::refine {

/// The edge length that the surface should have at a place: at most the one of the options, less where segments are
/// short, where two segments of a facet are near to each other and where the domain is thin between two facets.
/// From there it grows with the distance, times the grading.
///
/// Where walls are so thin that the surface would get far too many triangles, lengths fit the thinnest ones no more.
///
/// Facets and segments that meet are not near to each other in this sense: at a small angle the length would go to
/// zero.
class SurfaceSizes {
 public:
  /// \param edge_length  positive, in grid units
  SurfaceSizes(const plc::Plc& plc, double edge_length, double grading);

  double at(const Point3& p) const;

 private:
  double largest_, grading_;
  lattice::SizeTree sources_;
};

}  // namespace ccdt::refine
