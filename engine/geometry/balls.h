#pragma once

#include <array>

#include "engine/base/box.h"
#include "engine/base/point.h"

/// Circumcenters and smallest balls, in floating point.
namespace ccdt {

/// The vector from a corner of a triangle to the center of its circumcircle. Infinite or not a number if the corners
/// are on one line.
///
/// \param u,v  from that corner to the others
inline Point3 to_circumcenter(const Point3& u, const Point3& v) {
  const Point3 n = cross(u, v);
  return (0.5 / squared_length(n)) * (squared_length(u) * cross(v, n) + squared_length(v) * cross(n, u));
}

/// The same for a tetrahedron and its sphere.
inline Point3 to_circumcenter(const Point3& u, const Point3& v, const Point3& w) {
  const Point3 vw = cross(v, w);
  return (0.5 / dot(u, vw)) *
         (squared_length(u) * vw + squared_length(v) * cross(w, u) + squared_length(w) * cross(u, v));
}

/// Covers the rounding of the test whether a point is in a smallest ball.
inline constexpr double margin_of_balls = 1e-9;

/// The smallest ball around a segment, slightly enlarged, so that a point on the boundary counts as inside.
Ball smallest_ball(const Point3& a, const Point3& b);
/// The smallest ball around a triangle (the paper's minimal circumsphere), enlarged likewise.
Ball smallest_ball(const std::array<Point3, 3>& triangle);

}  // namespace ccdt
