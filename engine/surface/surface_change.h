#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/input.h"

namespace ccdt::surface {

/// How far a new surface is from the one that it replaces, in units of the input. The distances are upper bounds, at
/// most 3% too large or 1e-6 of the bounding box, or less if the deviation was bounded.
struct SurfaceChange {
  double distance = 0;                  ///< the Hausdorff distance: the larger one of these
  double to_input = 0;                  ///< no point of the new surface is farther from the old one
  double from_input = 0;                ///< no point of the old surface is farther from the new one
  std::array<double, 3> farthest = {};  ///< a point that is about so far away
  double area_change = 0;
  std::optional<double> volume_change = {};  ///< if both surfaces are closed, and all triangles at an edge agree about
                                             ///< which side is inside
};

/// \param after      made of `before`
/// \param deviation  the distance that was allowed; 0: any
/// \throw InputError  a polygon is invalid
SurfaceChange measure_change(const plc::InputPlc& before, const plc::InputPlc& after, double deviation = 0);

/// Points of the new surface at places where one surface is farther from the other than a distance, or nearly so: at
/// least 0.97 times it.
///
/// \throw InputError  a polygon is invalid
std::vector<Point3> points_beyond(const plc::InputPlc& before, const plc::InputPlc& after, double distance);

}  // namespace ccdt::surface
