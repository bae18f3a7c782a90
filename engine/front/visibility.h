#pragma once

#include <array>

#include "engine/base/point.h"
#include "engine/numbers/filters.h"
#include "engine/numbers/predicates.h"

namespace ccdt {

/// A triangle that may be in the way.
using Occluder = std::array<const Point3*, 3>;

/// Do filters tell that the line from p to the centroid of abc meets not the inside of t? Nearly all occluders that are
/// tried are passed by widely, and signs that take exact arithmetic, of coplanar points, need not be known then.
inline bool surely_passes_by(const Occluder& t, const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
  int turns_seen = 0;  // a bit for each sign
  const auto add = [&](Sign turn) { turns_seen |= turn == Sign::plus ? 1 : turn == Sign::minus ? 2 : 0; };
  add(orient3d_centroid_filter(p, *t[0], *t[1], a, b, c));
  add(orient3d_centroid_filter(p, *t[1], *t[2], a, b, c));
  if (turns_seen == 3) return true;
  add(orient3d_centroid_filter(p, *t[2], *t[0], a, b, c));
  if (turns_seen == 3) return true;
  const Sign side_of_p = orient3d_filter(*t[0], *t[1], *t[2], p);
  return side_of_p == Sign::zero ||
         (side_of_p != Sign::unknown && side_of_p == orient3d_centroid_filter(*t[0], *t[1], *t[2], a, b, c));
}

/// Does the triangle t hide the point p from the (generically moved) centroid of the triangle abc? Exactly: touching is
/// not crossing.
inline bool hides(const Occluder& t, const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
  if (surely_passes_by(t, p, a, b, c)) return false;
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
