#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "engine/base/box.h"
#include "engine/base/point.h"
#include "engine/plc/periodicity.h"

namespace ccdt::plc {

/// The box that repeats, and its sides.
struct Period {
  Box box;
  std::array<bool, 3> repeats = {};  ///< by axis

  /// The axes on one of whose two sides all of these points are, as bits.
  unsigned sides_of(std::span<const Point3> points) const {
    unsigned sides = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = as_array(points[0])[axis];
      bool is_there = repeats[axis] && (at == as_array(box.low)[axis] || at == as_array(box.high)[axis]);
      for (const Point3& p : points) is_there = is_there && as_array(p)[axis] == at;
      sides |= unsigned{is_there} << axis;
    }
    return sides;
  }
  /// The point that repeats this one and is on no upper side.
  Point3 folded(const Point3& p) const {
    Point3 lower = p;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (repeats[axis] && as_array(p)[axis] == as_array(box.high)[axis]) lower = lower - extent_along(axis);
    return lower;
  }
  Point3 extent_along(std::size_t axis) const {
    const Point3 extent = box.high - box.low;
    return {axis == 0 ? extent.x : 0, axis == 1 ? extent.y : 0, axis == 2 ? extent.z : 0};
  }
};

inline Period period_of(std::span<const Point3> points, Periodicity periodicity) {
  Period period{.box = bounding_box(points)};
  for (std::size_t axis = 0; axis < 3; ++axis)
    period.repeats[axis] = (static_cast<unsigned>(periodicity) >> axis & 1) != 0;
  return period;
}

}  // namespace ccdt::plc
