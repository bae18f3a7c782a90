#pragma once

#include <array>
#include <cmath>

#include "engine/base/portable_math.h"

namespace ccdt {

/// A point or a vector in space. In the engine the coordinates are integers in *grid units* (see grid.h), held in
/// doubles; at its border (files, `TetMesh`) they are in the units of the input.
struct Point3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Point3&, const Point3&) = default;
};

inline Point3 operator-(const Point3& a, const Point3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point3 operator+(const Point3& a, const Point3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point3 operator*(double s, const Point3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(const Point3& a, const Point3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const Point3& a) {
  return dot(a, a);
}
inline double length(const Point3& a) {
  return std::sqrt(squared_length(a));
}
inline Point3 componentwise_min(const Point3& a, const Point3& b) {
  return {b.x < a.x ? b.x : a.x, b.y < a.y ? b.y : a.y, b.z < a.z ? b.z : a.z};
}
inline Point3 componentwise_max(const Point3& a, const Point3& b) {
  return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}
inline bool is_finite(const Point3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
inline std::array<double, 3> as_array(const Point3& a) {
  return {a.x, a.y, a.z};
}

/// The vector scaled to length one; a vector of length zero stays as it is.
inline Point3 normalized(const Point3& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

/// The normal of a triangle, as long as twice its area.
inline Point3 area_vector(const std::array<Point3, 3>& p) {
  return cross(p[1] - p[0], p[2] - p[0]);
}

/// The angle at a between b and c, in radians.
inline double angle_at(const Point3& a, const Point3& b, const Point3& c) {
  return portable::angle_of(dot(b - a, c - a), length(cross(b - a, c - a)));
}

inline double to_radians(double degrees) {
  return degrees * (portable::pi / 180);
}

}  // namespace ccdt
