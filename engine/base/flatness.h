#pragma once

#include <span>

#include "engine/base/point.h"

namespace ccdt {

/// Flat facets whose vertices are rounded to double precision stay flat within this fraction of the bounding box.
inline constexpr double usual_flatness = 1e-8;

/// The tolerance for a patch to be flat, as a fraction of the largest extent of the points. The usual tolerance is
/// raised if rounding bends flat facets by more: that of coordinates in single precision, as in a binary STL, and that
/// of coordinates far from the origin. Any other tolerance stays as it is.
///
/// \param points     in the units of the input
/// \param tolerance  the requested one, as such a fraction
double flatness_for(std::span<const Point3> points, double tolerance);

}  // namespace ccdt
