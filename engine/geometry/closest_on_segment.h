#pragma once

#include <algorithm>

#include "engine/base/point.h"

namespace ccdt {

/// The point of the line segment from a to b that is nearest to p, in floating point. a and b may be the same point.
inline Point3 closest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
  if (a == b) return a;
  const Point3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
  return a + t * along;
}

}  // namespace ccdt
