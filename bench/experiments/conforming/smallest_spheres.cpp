#include "bench/experiments/conforming/smallest_spheres.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

#include "engine/base/box.h"
#include "engine/geometry/balls.h"
#include "engine/geometry/box_tree.h"

namespace ccdt::conforming {
namespace {

/// Products of six differences of 53 bits, and sums of a few of them.
using WideInteger = boost::multiprecision::int512_t;
using WideVector = std::array<WideInteger, 3>;

WideVector wide(const Point3& p) {
  return {WideInteger(p.x), WideInteger(p.y), WideInteger(p.z)};
}

WideInteger dot_of(const WideVector& a, const WideVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

WideVector cross_of(const WideVector& a, const WideVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int exact_side(const WideVector& u, const WideVector& v, const WideVector& w) {
  const WideVector n = cross_of(u, v);
  const WideInteger inside =
      dot_of(u, u) * dot_of(w, cross_of(v, n)) + dot_of(v, v) * dot_of(w, cross_of(n, u)) - dot_of(w, w) * dot_of(n, n);
  return inside.sign();
}

/// A box around the smallest sphere; none if rounding could make it too small, as for needles.
bool find_box(const std::array<Point3, 3>& t, Box& box) {
  const Point3 u = t[1] - t[0], v = t[2] - t[0];
  constexpr double least_sine = 1e-6;
  const double area2 = squared_length(cross(u, v));
  if (!(area2 > least_sine * least_sine * squared_length(u) * squared_length(v))) return false;
  const Point3 to_center = to_circumcenter(u, v);
  constexpr double room = 1e-3;  // much more than the rounding
  const double r = (1 + room) * length(to_center);
  const Point3 center = t[0] + to_center;
  box = {center - Point3{r, r, r}, center + Point3{r, r, r}};
  return true;
}

}  // namespace

// With u, v and w from the first corner to the others and to p, and n = u x v, the center of the sphere is at
// (u^2 (v x n) + v^2 (n x u)) / (2 n^2), and p is inside if w^2 < 2 w . center.
int side_of_smallest_sphere(const std::array<Point3, 3>& triangle, const Point3& p) {
  const Point3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], w = p - triangle[0], n = cross(u, v);
  const double uu = squared_length(u), vv = squared_length(v), ww = squared_length(w);
  const double inside = uu * dot(w, cross(v, n)) + vv * dot(w, cross(n, u)) - ww * squared_length(n);
  // The differences are exact. Every term is at most a product of lengths, and passes through fewer than 20 roundings.
  constexpr double rounding = 256 * std::numeric_limits<double>::epsilon();
  const double largest = std::sqrt(uu * vv * ww) * (uu * std::sqrt(vv) + vv * std::sqrt(uu)) + ww * uu * vv;
  if (std::fabs(inside) > rounding * largest) return inside > 0 ? 1 : -1;
  return exact_side(wide(u), wide(v), wide(w));
}

std::vector<SphereContent> contents_of_smallest_spheres(std::span<const std::array<VertexId, 3>> triangles,
                                                        std::span<const Point3> points) {
  const Box all = bounding_box(points);
  const BoxTree tree(points, [](const Point3& p) { return box_of(p); });
  std::vector<SphereContent> contents;
  for (const std::array<VertexId, 3>& t : triangles) {
    const std::array<Point3, 3> corners = {points[t[0]], points[t[1]], points[t[2]]};
    Box box;
    if (!find_box(corners, box)) box = all;
    SphereContent content = SphereContent::nothing;
    tree.for_each_meeting(box, [&](std::uint32_t v) {
      if (content == SphereContent::vertices || std::ranges::find(t, VertexId(v)) != t.end()) return;
      const int side = side_of_smallest_sphere(corners, points[v]);
      if (side > 0) content = SphereContent::vertices;
      if (side == 0) content = SphereContent::touching;
    });
    contents.push_back(content);
  }
  return contents;
}

}  // namespace ccdt::conforming
