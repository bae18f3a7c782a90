#pragma once

#include <span>

#include "engine/base/point.h"

namespace ccdt {

/// The dyadic grid on which all coordinates of the engine live.
///
/// Let `2^e` be the smallest power of two that is not less than the largest extent of the input's bounding box. Then
/// the quantum is `q = 2^(e-32)` and the grid unit is `q * 2^-20 = 2^(e-52)`. Input vertices are rounded to multiples
/// of the quantum, constructed points to multiples of the grid unit. Seen from the center of the box and measured in
/// grid units, every coordinate is an integer of at most 2^51 + 2^20 in magnitude: it fits a double, and so does the
/// **difference of any two coordinates, exactly**.
struct DyadicGrid {
  Point3 origin;    ///< units of the input; a multiple of the quantum near the center of the bounding box
  double unit = 1;  ///< one grid unit in units of the input; a power of two

  static constexpr double quantum = 1048576.0;  ///< the quantum in grid units, 2^20

  /// Rounds a point of the input to the nearest multiple of the quantum, in grid units.
  Point3 snap(const Point3& world) const;
  /// The point in the units of the input (rounded to the nearest double).
  Point3 to_world(const Point3& grid) const;
};

/// The grid of a set of finite points. A single point, or none, gets a grid of extent 1.
DyadicGrid make_grid(std::span<const Point3> world);

/// Rounds a coordinate in grid units to the nearest grid unit.
double round_to_unit(double grid);

}  // namespace ccdt
