#include "engine/geometry/exact_points.h"

#include <cstdint>
#include <utility>

namespace ccdt {
namespace {

ExactPoint make_point(std::array<Long, 3> numerator, Long denominator) {
  if (denominator < 0) {
    for (Long& x : numerator) x = -x;
    denominator = -denominator;
  }
  return {std::move(numerator), std::move(denominator)};
}

/// The point of pq with height 0, if heights are linear.
ExactPoint point_between(const IntegerPoint& p, const IntegerPoint& q, Wide p_height, Wide q_height) {
  std::array<Long, 3> numerator;
  for (std::size_t i = 0; i < 3; ++i) numerator[i] = Long(p_height) * q[i] - Long(q_height) * p[i];
  return make_point(std::move(numerator), Long(p_height - q_height));
}

/// Twice the area of abc, seen along the axis.
Wide area_along(int axis, const IntegerPoint& a, const IntegerPoint& b, const IntegerPoint& c) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return Wide(b[u] - a[u]) * (c[v] - a[v]) - Wide(b[v] - a[v]) * (c[u] - a[u]);
}

std::array<Long, 3> cross_product(const WideVector& a, const WideVector& b) {
  return {Long(a[1]) * b[2] - Long(a[2]) * b[1], Long(a[2]) * b[0] - Long(a[0]) * b[2],
          Long(a[0]) * b[1] - Long(a[1]) * b[0]};
}

double rounded_coordinate(const Long& numerator, const Long& denominator) {
  const Long twice = 2 * numerator + denominator;  // halves are rounded up
  const Long divisor = 2 * denominator;
  Long quotient = twice / divisor;  // rounds toward zero
  if (twice < 0 && quotient * divisor != twice) quotient -= 1;
  return DyadicGrid::quantum * static_cast<double>(static_cast<std::int64_t>(quotient));
}

}  // namespace

ExactPlane plane_of(const std::array<Point3, 3>& triangle) {
  const WideVector normal = exact_normal(triangle);
  const IntegerPoint p = to_integers(triangle[0]);
  return {normal, normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2]};
}

ExactPoint exactly(const Point3& vertex) {
  const IntegerPoint p = to_integers(vertex);
  return {{Long(p[0]), Long(p[1]), Long(p[2])}, 1};
}

ExactPoint meet_plane(const Point3& p, const Point3& q, const ExactPlane& plane) {
  const IntegerPoint from = to_integers(p), to = to_integers(q);
  const auto height = [&](const IntegerPoint& x) {
    return plane.normal[0] * x[0] + plane.normal[1] * x[1] + plane.normal[2] * x[2] - plane.offset;
  };
  return point_between(from, to, height(from), height(to));
}

ExactPoint meet_line(int axis, const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  const IntegerPoint from = to_integers(p), to = to_integers(q);
  const IntegerPoint start = to_integers(a), end = to_integers(b);
  return point_between(from, to, area_along(axis, start, end, from), area_along(axis, start, end, to));
}

ExactPoint meet_planes(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
  const std::array<Long, 3> bc = cross_product(b.normal, c.normal), ca = cross_product(c.normal, a.normal),
                            ab = cross_product(a.normal, b.normal);
  std::array<Long, 3> numerator;
  for (std::size_t i = 0; i < 3; ++i)
    numerator[i] = bc[i] * Long(a.offset) + ca[i] * Long(b.offset) + ab[i] * Long(c.offset);
  Long determinant = bc[0] * Long(a.normal[0]) + bc[1] * Long(a.normal[1]) + bc[2] * Long(a.normal[2]);
  return make_point(std::move(numerator), std::move(determinant));
}

int side_of_plane(const ExactPlane& plane, const ExactPoint& p) {
  VeryLong height = -VeryLong(plane.offset) * VeryLong(p.denominator);
  for (std::size_t i = 0; i < 3; ++i) height += VeryLong(plane.normal[i]) * VeryLong(p.numerator[i]);
  return height.sign();
}

int side_of_line(int axis, const Point3& a, const Point3& b, const ExactPoint& p) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
  const IntegerPoint from = to_integers(a), to = to_integers(b);
  const VeryLong denominator(p.denominator);
  const VeryLong x = VeryLong(p.numerator[u]) - denominator * from[u],
                 y = VeryLong(p.numerator[v]) - denominator * from[v];
  return VeryLong((to[u] - from[u]) * y - (to[v] - from[v]) * x).sign();
}

int compare_along(int axis, const ExactPoint& p, const ExactPoint& q) {
  const auto i = static_cast<std::size_t>(axis);
  return VeryLong(VeryLong(p.numerator[i]) * VeryLong(q.denominator) -
                  VeryLong(q.numerator[i]) * VeryLong(p.denominator))
      .sign();
}

bool are_equal(const ExactPoint& p, const ExactPoint& q) {
  return compare_along(0, p, q) == 0 && compare_along(1, p, q) == 0 && compare_along(2, p, q) == 0;
}

Point3 rounded(const ExactPoint& p) {
  return {rounded_coordinate(p.numerator[0], p.denominator), rounded_coordinate(p.numerator[1], p.denominator),
          rounded_coordinate(p.numerator[2], p.denominator)};
}

}  // namespace ccdt
