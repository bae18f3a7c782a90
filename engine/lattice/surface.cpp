#include "engine/lattice/surface.h"

#include <algorithm>
#include <cmath>

namespace ccdt {

namespace {

using Vector = std::array<double, 3>;

double smallest_abs_outside(double low, double high) {
  return std::max({low, -high, 0.0});
}

/// Does the axis (unit not needed) separate the box of the half extents `half`, centred at 0, from the triangle?
bool separates(const Vector& axis, const Vector& half, const std::array<Vector, 3>& corners, double slack) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Vector& v : corners) {
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const double radius = half[0] * std::abs(axis[0]) + half[1] * std::abs(axis[1]) + half[2] * std::abs(axis[2]);
  return smallest_abs_outside(low, high) > radius + slack;
}

/// Keeps the part of a convex polygon with sign * (coordinate - bound) >= 0.
void clip(std::vector<Vector>& polygon, int axis, double bound, double sign, std::vector<Vector>& scratch) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector& a = polygon[i];
    const Vector& b = polygon[(i + 1) % polygon.size()];
    const double inside_a = sign * (a[axis] - bound), inside_b = sign * (b[axis] - bound);
    if (inside_a >= 0) scratch.push_back(a);
    if ((inside_a > 0 && inside_b < 0) || (inside_a < 0 && inside_b > 0)) {
      const double t = inside_a / (inside_a - inside_b);
      Vector crossing;
      for (int k = 0; k < 3; ++k) crossing[k] = a[k] + t * (b[k] - a[k]);
      crossing[axis] = bound;
      scratch.push_back(crossing);
    }
  }
  polygon.swap(scratch);
}

}  // namespace

bool may_touch(const Box& box, const Corners& triangle, const Box& around) {
  if (!overlap(box, around)) return false;
  if (contains(box, around)) return true;
  const Point3 centre = box.centre();
  std::array<Vector, 3> corners, edges;
  double reach = 0;
  for (int i = 0; i < 3; ++i) {
    corners[i] = as_array(triangle[i] - centre);
    for (double c : corners[i]) reach = std::max(reach, std::abs(c));
  }
  // The box grows by a margin, so that rounding can only make us say that they touch.
  Vector half = as_array(0.5 * (box.high - box.low));
  for (double& h : half) h = h * (1 + 1e-9) + 1e-12 * reach;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    edges[i] = as_array(triangle[(i + 1) % 3] - triangle[i]);
    for (double c : edges[i]) longest = std::max(longest, std::abs(c));
  }
  const Vector normal = as_array(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  if (separates(normal, half, corners, 1e-14 * longest * longest * reach)) return false;
  for (const Vector& e : edges) {
    if (separates({0, -e[2], e[1]}, half, corners, 0) || separates({e[2], 0, -e[0]}, half, corners, 0) ||
        separates({-e[1], e[0], 0}, half, corners, 0))
      return false;
  }
  return true;
}

bool common_point(const Box& box, const Corners& triangle, Point3& point) {
  std::vector<Vector> polygon, scratch;
  polygon.reserve(9);
  scratch.reserve(9);
  for (const Point3& p : triangle) polygon.push_back(as_array(p));
  const Vector low = as_array(box.low), high = as_array(box.high);
  for (int axis = 0; axis < 3; ++axis) {
    clip(polygon, axis, low[axis], 1, scratch);
    clip(polygon, axis, high[axis], -1, scratch);
  }
  if (polygon.empty()) return false;
  Point3 sum;
  for (const Vector& v : polygon) sum = sum + Point3{v[0], v[1], v[2]};
  point = (1.0 / static_cast<double>(polygon.size())) * sum;
  return true;
}

double squared_distance(const Point3& a, const Point3& b, const Point3& p) {
  const Point3 ab = b - a, ap = p - a;
  const double length = squared_length(ab);
  const double t = length > 0 ? std::clamp(dot(ap, ab) / length, 0.0, 1.0) : 0;
  return squared_length(ap - t * ab);
}

double squared_distance(const Corners& triangle, const Point3& p) {
  const auto& [a, b, c] = triangle;
  const Point3 normal = cross(b - a, c - a);
  const double area = squared_length(normal);
  if (area > 0 && dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
      dot(cross(a - c, p - c), normal) >= 0) {
    const double height = dot(p - a, normal);
    return height * height / area;
  }
  return std::min({squared_distance(a, b, p), squared_distance(b, c, p), squared_distance(c, a, p)});
}

}  // namespace ccdt
