#pragma once

#include <algorithm>
#include <array>

#include "engine/numbers/point.h"
#include "engine/numbers/predicates.h"

namespace ccdt {

/// Does the triangle t hide the point p from the (generically moved) centroid of the triangle abc? Exactly: touching is
/// not crossing.
inline bool hides(const std::array<const Point3*, 3>& t, const Point3& p, const Point3& a, const Point3& b,
                  const Point3& c) {
  const int side_of_p = orient3d(*t[0], *t[1], *t[2], p);
  if (side_of_p == 0) return false;
  const int side_of_face = orient3d_centroid(*t[0], *t[1], *t[2], a, b, c);
  if (side_of_face != -side_of_p) return false;
  // The line of sight passes the three edges on the same side.
  const int turn = orient3d_centroid(p, *t[0], *t[1], a, b, c);
  return turn != 0 && orient3d_centroid(p, *t[1], *t[2], a, b, c) == turn &&
         orient3d_centroid(p, *t[2], *t[0], a, b, c) == turn;
}

/// The centroid in floating point, for boxes and cells.
inline Point3 approximate_centroid(const Point3& a, const Point3& b, const Point3& c) {
  return (1.0 / 3) * (a + b + c);
}

}  // namespace ccdt
