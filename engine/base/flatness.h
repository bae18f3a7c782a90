#pragma once

#include <span>

#include "engine/base/point.h"

namespace ccdt {

/// Flat facets whose vertices are rounded to double precision are flat within this fraction of the bounding box.
inline constexpr double usual_flatness = 1e-8;

/// The tolerance for a patch to be flat, as a fraction of the largest extent of the points. The usual tolerance is
/// raised where the coordinates have been rounded to single precision, as in a binary STL: that bends flat facets that
/// are not parallel to an axis. Any other tolerance stays as it is.
///
/// \param points     in the units of the input
/// \param tolerance  what was asked for, as such a fraction
double flatness_for(std::span<const Point3> points, double tolerance);

}  // namespace ccdt
