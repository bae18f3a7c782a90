#pragma once

#include <array>

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
inline std::array<double, 3> as_array(const Point3& a) {
  return {a.x, a.y, a.z};
}

}  // namespace ccdt
