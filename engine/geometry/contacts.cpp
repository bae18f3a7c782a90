#include "engine/geometry/contacts.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt {
namespace {

using Triangle = std::array<Point3, 3>;

bool is_between(double low, double x, double high) {
  return std::min(low, high) <= x && x <= std::max(low, high);
}

bool in_box_of(const Point3& a, const Point3& b, const Point3& p) {
  return is_between(a.x, p.x, b.x) && is_between(a.y, p.y, b.y) && is_between(a.z, p.z, b.z);
}

// Here and below, coplanar points are projected along an axis that is not parallel to their plane.
bool holds(int axis, const Triangle& t, const Point3& p) {
  const int u = orient_along(axis, t[0], t[1], p), v = orient_along(axis, t[1], t[2], p);
  if (u * v < 0) return false;
  const int w = orient_along(axis, t[2], t[0], p);
  return u * w >= 0 && v * w >= 0;
}

// The point of pq on the line ab, rounded.
Point3 crossing_of_lines(const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  const Point3 across = cross(cross(b - a, q - p), b - a);  // in their plane, perpendicular to ab
  const double from = dot(across, p - a), to = dot(across, q - a);
  if (from == to) return p;
  return p + (from / (from - to)) * (q - p);
}

std::optional<Contact> meet_in_plane(int axis, const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  const int pa = orient_along(axis, p, q, a), pb = orient_along(axis, p, q, b);
  if (pa * pb > 0) return std::nullopt;
  if (pa == 0 && pb == 0) {  // on one line
    for (const Point3& x : {a, b})
      if (in_box_of(p, q, x)) return Contact{x, true};
    if (in_box_of(a, b, p)) return Contact{p, true};
    return std::nullopt;
  }
  if (orient_along(axis, a, b, p) * orient_along(axis, a, b, q) > 0) return std::nullopt;
  return Contact{crossing_of_lines(p, q, a, b), true};
}

std::optional<Contact> meet_coplanar(const Point3& p, const Point3& q, const Triangle& t) {
  const int axis = axis_across(t);
  for (const Point3& x : {p, q})
    if (holds(axis, t, x)) return Contact{x, true};
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_in_plane(axis, p, q, t[k], t[(k + 1) % 3])) return contact;
  return std::nullopt;
}

// The signs of p and q against the plane of the triangle are known.
std::optional<Contact> meet_with_signs(const Point3& p, const Point3& q, int p_sign, int q_sign, const Triangle& t) {
  if (p_sign * q_sign > 0) return std::nullopt;
  if (p_sign == 0 && q_sign == 0) return meet_coplanar(p, q, t);
  if (!passes_through(p, q, t)) return std::nullopt;
  const Point3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double from = std::fabs(dot(normal, p - t[0])), to = std::fabs(dot(normal, q - t[0]));
  return Contact{p_sign == 0 ? p : q_sign == 0 ? q : p + (from / (from + to)) * (q - p), false};
}

using SeenTriangle = std::array<PlanePoint, 3>;

/// Is p, on the line of an edge, beyond this end of it?
bool is_beyond(const PlanePoint& end, const PlanePoint& other_end, const PlanePoint& p) {
  // Both products have the same sign, so rounding does not change the sign of their sum.
  return (other_end[0] - end[0]) * (p[0] - end[0]) + (other_end[1] - end[1]) * (p[1] - end[1]) < 0;
}

/// Is the other triangle beyond the line of an edge of the first? It may have corners on that line if they are beyond
/// one end of the edge, or common.
bool divides(const SeenTriangle& one, const SeenTriangle& other, int common) {
  const int sense = orient_in_plane(one[0], one[1], one[2]);
  if (sense == 0) return false;
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    if (common > 0 && (k == 1 || (common == 2 && k == 2))) continue;
    bool before = common == 0 || k == 0, after = common == 0 || k == 2;
    for (int j = common; j < 3 && (before || after); ++j) {
      const int side = orient_in_plane(one[k], one[next], other[j]);
      if (side == -sense) continue;
      before = before && side == 0 && is_beyond(one[k], one[next], other[j]);
      after = after && side == 0 && is_beyond(one[next], one[k], other[j]);
    }
    if (before || after) return true;
  }
  return false;
}

}  // namespace

Sides sides_of(const Triangle& plane, const Triangle& corners) {
  const auto& [a, b, c] = plane;
  return {orient3d(a, b, c, corners[0]), orient3d(a, b, c, corners[1]), orient3d(a, b, c, corners[2])};
}

bool passes_through(const Point3& p, const Point3& q, const Triangle& t) {
  const int u = orient3d(p, q, t[0], t[1]), v = orient3d(p, q, t[1], t[2]);
  if (u * v < 0) return false;
  const int w = orient3d(p, q, t[2], t[0]);
  return u * w >= 0 && v * w >= 0;
}

std::optional<Contact> meet_segment_triangle(const Point3& p, const Point3& q, const Triangle& t) {
  return meet_with_signs(p, q, orient3d(t[0], t[1], t[2], p), orient3d(t[0], t[1], t[2], q), t);
}

std::optional<Contact> meet_triangles(const Triangle& s, const Triangle& t) {
  const Sides s_signs = sides_of(t, s);
  if (are_on_one_side(s_signs)) return std::nullopt;
  const Sides t_signs = sides_of(s, t);
  if (are_on_one_side(t_signs)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_with_signs(s[k], s[(k + 1) % 3], s_signs[k], s_signs[(k + 1) % 3], t)) return contact;
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_with_signs(t[k], t[(k + 1) % 3], t_signs[k], t_signs[(k + 1) % 3], s)) return contact;
  return std::nullopt;
}

// Their intersection is convex and contains the common corner. If it contains more, it reaches the opposite edge in one
// of them.
std::optional<Contact> meet_triangles_at_corner(const Triangle& s, const Triangle& t) {
  const int s1 = orient3d(t[0], t[1], t[2], s[1]), s2 = orient3d(t[0], t[1], t[2], s[2]);
  if (s1 * s2 > 0) return std::nullopt;
  const int t1 = orient3d(s[0], s[1], s[2], t[1]), t2 = orient3d(s[0], s[1], s[2], t[2]);
  if (t1 * t2 > 0) return std::nullopt;
  if (auto contact = meet_with_signs(s[1], s[2], s1, s2, t)) return contact;
  return meet_with_signs(t[1], t[2], t1, t2, s);
}

std::optional<Contact> meet_elsewhere(const Triangle& s, const Triangle& t, int common) {
  if (common == 0) return meet_triangles(s, t);
  if (common == 1) return meet_triangles_at_corner(s, t);
  if (orient3d(s[0], s[1], s[2], t[2]) != 0) return std::nullopt;
  const int axis = axis_across(s);
  if (orient_along(axis, s[0], s[1], s[2]) != orient_along(axis, s[0], s[1], t[2])) return std::nullopt;
  return Contact{t[2], true};
}

std::optional<Contact> meet_segment_at_corner(const Point3& end, const Triangle& t) {
  if (orient3d(t[0], t[1], t[2], end) != 0) return std::nullopt;
  const int axis = dominant_axis(t);
  if (holds(axis, t, end)) return Contact{end, true};
  return meet_in_plane(axis, t[0], end, t[1], t[2]);
}

std::optional<Contact> meet_segments(const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  if (orient3d(p, q, a, b) != 0) return std::nullopt;
  Point3 normal = rounded_normal({p, q, a});
  if (normal == Point3{}) normal = rounded_normal({p, q, b});
  if (normal == Point3{}) normal = cross(q - p, dominant_axis(q - p) == 0 ? Point3{0, 1, 0} : Point3{1, 0, 0});
  return meet_in_plane(dominant_axis(normal), p, q, a, b);
}

// The projection is tested first: it rejects most points of the same plane, which are expensive for `orient3d`.
bool is_on_triangle(int axis, const Point3& p, const Triangle& t) {
  return holds(axis, t, p) && orient3d(t[0], t[1], t[2], p) == 0;
}

bool is_within_segment(const Point3& p, const Point3& a, const Point3& b) {
  return p != a && p != b && in_box_of(a, b, p) && has_no_area({a, b, p});
}

bool are_apart_seen_along(int axis, const std::array<Point3, 3>& s, const std::array<Point3, 3>& t, int common) {
  const SeenTriangle seen_s = {seen_along(axis, s[0]), seen_along(axis, s[1]), seen_along(axis, s[2])};
  const SeenTriangle seen_t = {seen_along(axis, t[0]), seen_along(axis, t[1]), seen_along(axis, t[2])};
  return divides(seen_s, seen_t, common) || divides(seen_t, seen_s, common);
}

}  // namespace ccdt
