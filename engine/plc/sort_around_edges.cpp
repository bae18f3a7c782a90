#include "engine/plc/sort_around_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/numbers/predicates.h"
#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

// For c and d coplanar with the edge ab: are they on the same side of it?
bool on_same_side(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const int axis = dominant_axis(rounded_normal(a, b, c));
  const Quanta qa = to_quanta(a), qb = to_quanta(b);
  return orient_along(axis, qa, qb, to_quanta(c)) == orient_along(axis, qa, qb, to_quanta(d));
}

// A facet is near another only if their angle says so, and narrow triangles make no reliable angle with anything.
constexpr double reliable_heights = 100;  // tolerances

bool nearly_cover(const Point3& a, const Point3& b, const Point3& c, const Point3& d, double tolerance) {
  const Point3 m = cross(b - a, c - a), n = cross(b - a, d - a);
  const double mm = squared_length(m), nn = squared_length(n);
  const double least = reliable_heights * tolerance;
  const double least_area = least * least * squared_length(b - a);
  if (dot(m, n) <= 0 || mm < least_area || nn < least_area) return false;
  return std::fabs(dot(m, d - a)) <= tolerance * std::sqrt(mm) && std::fabs(dot(n, c - a)) <= tolerance * std::sqrt(nn);
}

// A point of both triangles abc and abd, which are on the same side of ab: from the middle of the edge inwards until it
// is in both.
Point3 common_point(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 middle = 0.5 * (a + b), inwards = 0.5 * (c + d) - middle;
  const auto holds = [&](const Point3& apex, const Point3& p) {
    const Point3 normal = cross(b - a, apex - a);
    return dot(normal, cross(apex - b, p - b)) >= 0 && dot(normal, cross(a - apex, p - apex)) >= 0;
  };
  double step = 0.5;
  while (step > 1e-6 && !(holds(c, middle + step * inwards) && holds(d, middle + step * inwards))) step *= 0.5;
  return middle + step * inwards;
}

}  // namespace

Turn turn_about(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const int sign = orient3d(a, b, c, d);
  if (sign > 0) return Turn::below_180;
  if (sign < 0) return Turn::above_180;
  return on_same_side(a, b, c, d) ? Turn::zero : Turn::exactly_180;
}

std::optional<Overlap> sort_around_edges(std::span<const Point3> vertices, const TriangleSet& triangles,
                                         const std::vector<char>& is_inner_edge, double tolerance, EdgeTable& edges) {
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const std::span<std::uint32_t> around = edges.around(e);
    if (is_inner_edge[e] || around.size() < 2) continue;
    const Point3 &a = vertices[edges.ends[e][0]], &b = vertices[edges.ends[e][1]];
    const auto apex = [&](std::uint32_t t) -> const Point3& {
      return vertices[apex_over(triangles.corners[t], edges.ends[e][0], edges.ends[e][1])];
    };
    if (around.size() > 2) {
      const Point3& zero = apex(around[0]);
      std::sort(around.begin() + 1, around.end(), [&](std::uint32_t s, std::uint32_t t) {
        const Turn to_s = turn_about(a, b, zero, apex(s)), to_t = turn_about(a, b, zero, apex(t));
        if (to_s != to_t) return to_s < to_t;
        if (to_s == Turn::below_180 || to_s == Turn::above_180) {
          const int sign = orient3d(a, b, apex(s), apex(t));
          if (sign != 0) return sign > 0;
        }
        return s < t;
      });
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (i == 1 && around.size() == 2) break;  // the same pair once more
      const std::uint32_t s = around[i], t = around[(i + 1) % around.size()];
      const Point3 &c = apex(s), &d = apex(t);
      if (nearly_cover(a, b, c, d, tolerance) || turn_about(a, b, c, d) == Turn::zero)
        return Overlap{Overlap::Between::covering_facets, s, t, common_point(a, b, c, d)};
    }
  }
  return std::nullopt;
}

}  // namespace ccdt
