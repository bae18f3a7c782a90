#pragma once

#include <array>
#include <cmath>

#include "engine/base/box.h"
#include "engine/base/point.h"

namespace ccdt {

/// Where the ray through a line segment crosses a triangle, in lengths of the segment; infinite if it does not (Moeller
/// and Trumbore 1997).
inline double crossing_of(const LineSegment& s, const std::array<Point3, 3>& t) {
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0], from_a = s.from - t[0];
  const Point3 across = cross(s.along, ac), aside = cross(from_a, ab);
  const double det = dot(ab, across);
  const double u = dot(from_a, across) / det, v = dot(s.along, aside) / det, where = dot(ac, aside) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && where >= 0 ? where : HUGE_VAL;  // false if det is 0
}

}  // namespace ccdt
