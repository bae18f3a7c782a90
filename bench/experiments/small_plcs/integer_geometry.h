#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// Exact geometry of a few points with small whole coordinates, and of plain piecewise linear complexes of these. It
/// shares nothing with the engine, so that one can be held against the other.
namespace ccdt::small {

/// A point or a vector. No determinant overflows as long as coordinates are at most `largest_coordinate` in magnitude.
struct Point {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
inline constexpr std::int64_t largest_coordinate = 1000;

inline Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point operator*(std::int64_t s, const Point& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline std::int64_t dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline std::int64_t determinant(const Point& a, const Point& b, const Point& c) {
  return dot(cross(a, b), c);
}

/// Six times the signed volume of abcd: positive when abc is seen counterclockwise from d.
std::int64_t six_volumes(const Point& a, const Point& b, const Point& c, const Point& d);

/// Its sign.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// +1 when e is strictly inside the circumsphere of abcd, 0 on it, -1 outside, however abcd is oriented.
/// \pre abcd are not coplanar
int side_of_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& e);

/// Does the segment pq go through the triangle abc in one point that is inside both? False if any four of the five
/// points are coplanar.
bool pierces(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c);

/// Do the inside of a tetrahedron and the relative inside of another simplex (a tetrahedron, triangle or segment) have
/// a point in common? Searched are all planes that could separate them: those along a face of one, or along an edge of
/// each.
bool insides_meet(const std::array<Point, 4>& tetrahedron, std::span<const Point> simplex);

}  // namespace ccdt::small
