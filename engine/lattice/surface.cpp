#include "engine/lattice/surface.h"

#include <algorithm>
#include <cmath>

namespace ccdt {

namespace {

using Vector = std::array<double, 3>;

/// A triangle has at most nine corners after six cuts.
struct Polygon {
  std::array<Vector, 9> corners;
  std::size_t count = 0;

  void add(const Vector& v) { corners[count++] = v; }
};

/// The part of a convex polygon with sign * (coordinate - bound) >= 0.
Polygon clip(const Polygon& polygon, int axis, double bound, double sign) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vector& a = polygon.corners[i];
    const Vector& b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
    const double inside_a = sign * (a[axis] - bound), inside_b = sign * (b[axis] - bound);
    if (inside_a >= 0) part.add(a);
    if ((inside_a > 0 && inside_b < 0) || (inside_a < 0 && inside_b > 0)) {
      const double t = inside_a / (inside_a - inside_b);
      Vector crossing;
      for (int k = 0; k < 3; ++k) crossing[k] = a[k] + t * (b[k] - a[k]);
      crossing[axis] = bound;
      part.add(crossing);
    }
  }
  return part;
}

}  // namespace

TouchingPlaces::TouchingPlaces(const Corners& triangle, const Point3& half, double reach) : corner_(triangle[0]) {
  const Point3 ab = triangle[1] - triangle[0], bc = triangle[2] - triangle[1], ca = triangle[0] - triangle[2];
  double longest = 0;
  for (const Point3& edge : {ab, bc, ca})
    for (const double c : as_array(edge)) longest = std::max(longest, std::abs(c));
  // The boxes grow by a margin, so that rounding can only make us say that they touch.
  const auto grown = [&](double h) { return h * (1 + 1e-9) + 1e-12 * reach; };
  const Point3 size{grown(half.x), grown(half.y), grown(half.z)};
  std::size_t count = 0;
  const auto add = [&](const Point3& axis, double slack) {
    const double b = dot(axis, ab), c = -dot(axis, ca);
    const double radius = size.x * std::abs(axis.x) + size.y * std::abs(axis.y) + size.z * std::abs(axis.z) + slack;
    slabs_[count++] = {axis, std::min({0.0, b, c}) - radius, std::max({0.0, b, c}) + radius};
  };
  add(cross(ab, triangle[2] - triangle[0]), 1e-14 * longest * longest * reach);
  for (const Point3& edge : {ab, bc, ca}) {
    add({0, -edge.z, edge.y}, 0);
    add({edge.z, 0, -edge.x}, 0);
    add({-edge.y, edge.x, 0}, 0);
  }
}

bool common_point(const Box& box, const Corners& triangle, Point3& point) {
  Polygon polygon;
  for (const Point3& p : triangle) polygon.add(as_array(p));
  const Vector low = as_array(box.low), high = as_array(box.high);
  for (int axis = 0; axis < 3; ++axis) {
    polygon = clip(polygon, axis, low[axis], 1);
    polygon = clip(polygon, axis, high[axis], -1);
  }
  if (polygon.count == 0) return false;
  Point3 sum;
  for (std::size_t i = 0; i < polygon.count; ++i)
    sum = sum + Point3{polygon.corners[i][0], polygon.corners[i][1], polygon.corners[i][2]};
  point = (1.0 / static_cast<double>(polygon.count)) * sum;
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
