#pragma once

#include <array>
#include <cmath>

#include "engine/numbers/point.h"

namespace ccdt {

inline double length(const Point3& a) {
  return std::sqrt(squared_length(a));
}

/// The vector at length one; a vector of no length stays as it is.
inline Point3 unit(const Point3& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

/// Twice the area of a triangle, along its normal.
inline Point3 area_vector(const std::array<Point3, 3>& p) {
  return cross(p[1] - p[0], p[2] - p[0]);
}

/// The angle at a between b and c, in radians.
inline double angle_at(const Point3& a, const Point3& b, const Point3& c) {
  return std::atan2(length(cross(b - a, c - a)), dot(b - a, c - a));
}

inline double radians(double degrees) {
  return degrees * (std::acos(-1.0) / 180);
}

}  // namespace ccdt
