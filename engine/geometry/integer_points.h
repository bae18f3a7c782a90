#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/base/point.h"
#include "engine/geometry/grid.h"
#include "engine/geometry/predicates.h"

namespace ccdt {

/// Input vertices are multiples of the quantum, so they are integers of 33 bits when measured in quanta. Normals and
/// planar orientations then fit in 128 bits and need no filter.
using Wide = Int128;

using IntegerPoint = std::array<std::int64_t, 3>;
using WideVector = std::array<Wide, 3>;

/// A vertex of the input, or a difference of two, measured in quanta.
inline IntegerPoint to_integers(const Point3& p) {
  constexpr double inverse = 1.0 / DyadicGrid::quantum;
  return {static_cast<std::int64_t>(p.x * inverse), static_cast<std::int64_t>(p.y * inverse),
          static_cast<std::int64_t>(p.z * inverse)};
}

/// (b - a) x (c - a), exactly.
inline WideVector exact_normal(const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
  const std::int64_t ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const std::int64_t vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  return {Wide(uy) * vz - Wide(uz) * vy, Wide(uz) * vx - Wide(ux) * vz, Wide(ux) * vy - Wide(uy) * vx};
}

inline WideVector exact_normal(const std::array<Point3, 3>& t) {
  return exact_normal(to_integers(t[0]), to_integers(t[1]), to_integers(t[2]));
}

/// The height of q above the plane through a, times the length of its normal.
inline Wide height_over(const IntegerPoint& a, const WideVector& normal, const IntegerPoint& q) {
  return normal[0] * (q[0] - a[0]) + normal[1] * (q[1] - a[1]) + normal[2] * (q[2] - a[2]);
}

/// The exact normal rounded to doubles; zero components stay zero and signs are exact.
inline Point3 rounded_normal(const std::array<Point3, 3>& t) {
  const Point3 u = t[1] - t[0], v = t[2] - t[0];
  // If edges are shorter than 2^31 quanta, differences of products have at most 63 bits.
  const auto is_short = [](const Point3& p) {
    return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) < 0x1p31 * DyadicGrid::quantum;
  };
  if (is_short(u) && is_short(v)) {
    const IntegerPoint p = to_integers(u), q = to_integers(v);
    return {static_cast<double>(p[1] * q[2] - p[2] * q[1]), static_cast<double>(p[2] * q[0] - p[0] * q[2]),
            static_cast<double>(p[0] * q[1] - p[1] * q[0])};
  }
  const WideVector n = exact_normal(t);
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// Does the difference of two rounded products of exact factors have the sign that it seems to have? Its error is below
/// 2^-52 of the sum of their magnitudes.
inline bool is_certain(double p, double q) {
  return std::fabs(p - q) > 1e-15 * (std::fabs(p) + std::fabs(q));
}

inline bool has_no_area(const std::array<Point3, 3>& t) {
  const Point3 u = t[1] - t[0], v = t[2] - t[0];
  if (is_certain(u.x * v.y, u.y * v.x) || is_certain(u.y * v.z, u.z * v.y) || is_certain(u.z * v.x, u.x * v.z))
    return false;
  return rounded_normal(t) == Point3{};
}

/// The axis along which a vector is longest: 0, 1 or 2.
inline int dominant_axis(const Point3& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// An axis that is not parallel to the plane of a triangle.
inline int dominant_axis(const std::array<Point3, 3>& t) {
  return dominant_axis(rounded_normal(t));
}

/// Exact orientation of abc seen against the axis: the sign of that component of (b - a) x (c - a).
inline int orient_along(int axis, const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return sign_of(Wide(b[u] - a[u]) * (c[v] - a[v]) - Wide(b[v] - a[v]) * (c[u] - a[u]));
}

/// A point in the plane across an axis.
using PlanePoint = std::array<double, 2>;

inline PlanePoint seen_along(int axis, const Point3& p) {
  return axis == 0 ? PlanePoint{p.y, p.z} : axis == 1 ? PlanePoint{p.z, p.x} : PlanePoint{p.x, p.y};
}

/// The same orientation, of points on the grid.
inline int orient_in_plane(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  const double p = (b[0] - a[0]) * (c[1] - a[1]), q = (b[1] - a[1]) * (c[0] - a[0]);
  if (is_certain(p, q)) return p > q ? 1 : -1;
  const auto product = [](double x, double y) {
    return Wide(static_cast<std::int64_t>(x)) * static_cast<std::int64_t>(y);
  };
  return sign_of(product(b[0] - a[0], c[1] - a[1]) - product(b[1] - a[1], c[0] - a[0]));
}
inline int orient_along(int axis, const Point3& a, const Point3& b, const Point3& c) {
  return orient_in_plane(seen_along(axis, a), seen_along(axis, b), seen_along(axis, c));
}

/// An axis that is not parallel to the plane of a triangle, whose corners need not be vertices of the input.
inline int axis_across(const std::array<Point3, 3>& t) {
  for (const int axis : {0, 1})
    if (orient_along(axis, t[0], t[1], t[2]) != 0) return axis;
  return 2;
}

}  // namespace ccdt
