#include "engine/plc/intersect_triangles.h"

#include <algorithm>
#include <cmath>

#include "engine/numbers/predicates.h"
#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

using Triangle = std::array<Point3, 3>;

// Coplanar points, seen along an axis that their plane is not parallel to.
struct View {
  int axis;
  int orient(const Point3& a, const Point3& b, const Point3& c) const {
    return orient_along(axis, to_quanta(a), to_quanta(b), to_quanta(c));
  }
};

View view_of(const Triangle& t) {
  return {dominant_axis(rounded_normal(t[0], t[1], t[2]))};
}

bool is_between(double low, double x, double high) {
  return std::min(low, high) <= x && x <= std::max(low, high);
}

bool in_box_of(const Point3& a, const Point3& b, const Point3& p) {
  return is_between(a.x, p.x, b.x) && is_between(a.y, p.y, b.y) && is_between(a.z, p.z, b.z);
}

bool holds(View view, const Triangle& t, const Point3& p) {
  const int u = view.orient(t[0], t[1], p), v = view.orient(t[1], t[2], p);
  if (u * v < 0) return false;
  const int w = view.orient(t[2], t[0], p);
  return u * w >= 0 && v * w >= 0;
}

// The point of pq on the line ab, rounded.
Point3 crossing_of_lines(const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  const Point3 across = cross(cross(b - a, q - p), b - a);  // in their plane, perpendicular to ab
  const double from = dot(across, p - a), to = dot(across, q - a);
  if (from == to) return p;
  return p + (from / (from - to)) * (q - p);
}

std::optional<Contact> meet_in_plane(View view, const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  const int pa = view.orient(p, q, a), pb = view.orient(p, q, b);
  if (pa * pb > 0) return std::nullopt;
  if (pa == 0 && pb == 0) {  // on one line
    for (const Point3& x : {a, b})
      if (in_box_of(p, q, x)) return Contact{x, true};
    if (in_box_of(a, b, p)) return Contact{p, true};
    return std::nullopt;
  }
  if (view.orient(a, b, p) * view.orient(a, b, q) > 0) return std::nullopt;
  return Contact{crossing_of_lines(p, q, a, b), true};
}

std::optional<Contact> meet_coplanar(const Point3& p, const Point3& q, const Triangle& t) {
  const View view = view_of(t);
  for (const Point3& x : {p, q})
    if (holds(view, t, x)) return Contact{x, true};
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_in_plane(view, p, q, t[k], t[(k + 1) % 3])) return contact;
  return std::nullopt;
}

// The signs of p and q against the plane of the triangle are known.
std::optional<Contact> meet_with_signs(const Point3& p, const Point3& q, int p_sign, int q_sign, const Triangle& t) {
  if (p_sign * q_sign > 0) return std::nullopt;
  if (p_sign == 0 && q_sign == 0) return meet_coplanar(p, q, t);
  const int u = orient3d(p, q, t[0], t[1]), v = orient3d(p, q, t[1], t[2]), w = orient3d(p, q, t[2], t[0]);
  const bool same_turn = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  if (!same_turn) return std::nullopt;
  const Point3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double from = std::fabs(dot(normal, p - t[0])), to = std::fabs(dot(normal, q - t[0]));
  return Contact{p_sign == 0 ? p : q_sign == 0 ? q : p + (from / (from + to)) * (q - p), false};
}

std::array<int, 3> signs_against(const Triangle& t, const Triangle& corners) {
  return {orient3d(t[0], t[1], t[2], corners[0]), orient3d(t[0], t[1], t[2], corners[1]),
          orient3d(t[0], t[1], t[2], corners[2])};
}

bool on_one_side(const std::array<int, 3>& s) {
  return (s[0] == s[1] && s[1] == s[2] && s[0] != 0);
}

}  // namespace

std::optional<Contact> meet_segment_triangle(const Point3& p, const Point3& q, const Triangle& t) {
  return meet_with_signs(p, q, orient3d(t[0], t[1], t[2], p), orient3d(t[0], t[1], t[2], q), t);
}

bool are_apart_in_plane(int axis, const Triangle& s, const Triangle& t, int common) {
  const auto quanta = [](const Triangle& u) {
    return std::array<Quanta, 3>{to_quanta(u[0]), to_quanta(u[1]), to_quanta(u[2])};
  };
  const std::array<Quanta, 3> qs = quanta(s), qt = quanta(t);
  // Does the line of an edge of the one have it and the other on different sides? A common corner, the first of both,
  // may be on the line.
  const auto divides = [&](const std::array<Quanta, 3>& one, const std::array<Quanta, 3>& other) {
    const int sense = orient_along(axis, one[0], one[1], one[2]);
    for (int k = 0; k < 3; ++k) {
      const bool through_common = common == 1 && k != 1;
      int j = through_common ? 1 : 0;
      while (j < 3 && orient_along(axis, one[k], one[(k + 1) % 3], other[j]) == -sense) ++j;
      if (j == 3) return true;
    }
    return false;
  };
  return divides(qs, qt) || divides(qt, qs);
}

std::optional<Contact> meet_triangles(const Triangle& s, const Triangle& t) {
  const std::array<int, 3> s_signs = signs_against(t, s);
  if (on_one_side(s_signs)) return std::nullopt;
  const std::array<int, 3> t_signs = signs_against(s, t);
  if (on_one_side(t_signs)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_with_signs(s[k], s[(k + 1) % 3], s_signs[k], s_signs[(k + 1) % 3], t)) return contact;
  for (int k = 0; k < 3; ++k)
    if (const auto contact = meet_with_signs(t[k], t[(k + 1) % 3], t_signs[k], t_signs[(k + 1) % 3], s)) return contact;
  return std::nullopt;
}

// Their intersection is convex and holds the common corner. If it holds more, then it reaches the opposite edge of one
// of them.
std::optional<Contact> meet_triangles_at_corner(const Triangle& s, const Triangle& t) {
  const int s1 = orient3d(t[0], t[1], t[2], s[1]), s2 = orient3d(t[0], t[1], t[2], s[2]);
  if (s1 * s2 > 0) return std::nullopt;
  const int t1 = orient3d(s[0], s[1], s[2], t[1]), t2 = orient3d(s[0], s[1], s[2], t[2]);
  if (t1 * t2 > 0) return std::nullopt;
  if (auto contact = meet_with_signs(s[1], s[2], s1, s2, t)) return contact;
  return meet_with_signs(t[1], t[2], t1, t2, s);
}

std::optional<Contact> meet_segment_at_corner(const Point3& end, const Triangle& t) {
  if (orient3d(t[0], t[1], t[2], end) != 0) return std::nullopt;
  const View view = view_of(t);
  if (holds(view, t, end)) return Contact{end, true};
  return meet_in_plane(view, t[0], end, t[1], t[2]);
}

std::optional<Contact> meet_segments(const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  if (orient3d(p, q, a, b) != 0) return std::nullopt;
  Point3 normal = rounded_normal(p, q, a);
  if (normal == Point3{}) normal = rounded_normal(p, q, b);
  if (normal == Point3{}) normal = cross(q - p, dominant_axis(q - p) == 0 ? Point3{0, 1, 0} : Point3{1, 0, 0});
  return meet_in_plane({dominant_axis(normal)}, p, q, a, b);
}

// The projection first: it rejects most points of the same plane, which are dear for `orient3d`.
bool is_on_triangle(int axis, const Point3& p, const Triangle& t) {
  return holds({axis}, t, p) && orient3d(t[0], t[1], t[2], p) == 0;
}

bool is_within_segment(const Point3& p, const Point3& a, const Point3& b) {
  return p != a && p != b && in_box_of(a, b, p) && rounded_normal(a, b, p) == Point3{};
}

}  // namespace ccdt
