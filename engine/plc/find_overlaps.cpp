#include "engine/plc/find_overlaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt::plc {
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
  const int u = numbers::orient3d(p, q, t[0], t[1]), v = numbers::orient3d(p, q, t[1], t[2]),
            w = numbers::orient3d(p, q, t[2], t[0]);
  const bool same_turn = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  if (!same_turn) return std::nullopt;
  const Point3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double from = std::fabs(dot(normal, p - t[0])), to = std::fabs(dot(normal, q - t[0]));
  return Contact{p_sign == 0 ? p : q_sign == 0 ? q : p + (from / (from + to)) * (q - p), false};
}

std::array<int, 3> signs_against(const Triangle& t, const Triangle& corners) {
  return {numbers::orient3d(t[0], t[1], t[2], corners[0]), numbers::orient3d(t[0], t[1], t[2], corners[1]),
          numbers::orient3d(t[0], t[1], t[2], corners[2])};
}

bool on_one_side(const std::array<int, 3>& s) {
  return (s[0] == s[1] && s[1] == s[2] && s[0] != 0);
}

// The corners turned so that the given one is the first.
VertexTriple from_corner(const VertexTriple& c, VertexId v) {
  return c[0] == v ? c : c[1] == v ? VertexTriple{c[1], c[2], c[0]} : VertexTriple{c[2], c[0], c[1]};
}

std::optional<Contact> meet(std::span<const Point3> vertices, const VertexTriple& s, const VertexTriple& t) {
  int common = 0;
  VertexId corner = s[0];
  for (const VertexId v : s)
    if (has_corner(t, v)) {
      ++common;
      corner = v;
    }
  if (common >= 2) return std::nullopt;
  const Triangle p = points_of(vertices, common == 1 ? from_corner(s, corner) : s);
  const Triangle q = points_of(vertices, common == 1 ? from_corner(t, corner) : t);
  return common == 1 ? meet_triangles_at_corner(p, q) : meet_triangles(p, q);
}

bool are_coplanar(const Triangle& s, const Triangle& t) {
  return std::all_of(t.begin(), t.end(), [&](const Point3& p) { return numbers::orient3d(s[0], s[1], s[2], p) == 0; });
}

std::optional<Contact> meet_loose(std::span<const Point3> vertices, const std::array<VertexId, 2>& ends,
                                  const VertexTriple& t) {
  for (int k = 0; k < 2; ++k)
    if (has_corner(t, ends[k]))
      return meet_segment_at_corner(vertices[ends[1 - k]], points_of(vertices, from_corner(t, ends[k])));
  return meet_segment_triangle(vertices[ends[0]], vertices[ends[1]], points_of(vertices, t));
}

bool share_end(const std::array<VertexId, 2>& a, const std::array<VertexId, 2>& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

}  // namespace

std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, std::span<const TrianglePair> close, std::size_t limit) {
  const auto find_overlap = [&](const TrianglePair& pair, std::vector<Overlap>& found) {
    const auto [i, j] = pair;
    const std::uint32_t facet = facets.facet_of[i];
    if (facet == facets.facet_of[j] && !facets.exactly_flat[facet]) return;
    const VertexTriple &s = triangles.corners[i], &t = triangles.corners[j];
    if (const auto contact = meet(vertices, s, t)) {
      const bool covering = contact->coplanar && are_coplanar(points_of(vertices, s), points_of(vertices, t));
      found.push_back({covering ? Overlap::Between::covering_facets : Overlap::Between::facets, i, j, contact->where});
    }
  };
  std::vector<Overlap> all = parallel_collect<Overlap>(
      close.size(), 1024, [&](std::size_t begin, std::size_t end, std::vector<Overlap>& found) {
        for (; begin < end && found.size() < limit; ++begin) find_overlap(close[begin], found);
      });
  if (all.size() > limit) all.erase(all.begin() + static_cast<std::ptrdiff_t>(limit), all.end());
  return all;
}

std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit) {
  std::vector<Overlap> found;
  RawVector<Box> boxes;
  for (const std::uint32_t s : loose) {
    const auto& ends = segments.ends[s];
    boxes.push_back(hull(box_of(vertices[ends[0]]), box_of(vertices[ends[1]])));
    tree.for_each_meeting(boxes.back(), [&](std::uint32_t t) {
      if (found.size() >= limit) return;
      if (const auto contact = meet_loose(vertices, ends, triangles.corners[t]))
        found.push_back({Overlap::Between::facet_and_segment, t, s, contact->where});
    });
  }
  BoxTree(std::move(boxes)).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const auto &a = segments.ends[loose[i]], &b = segments.ends[loose[j]];
    if (found.size() >= limit || share_end(a, b)) return;
    if (const auto contact = meet_segments(vertices[a[0]], vertices[a[1]], vertices[b[0]], vertices[b[1]]))
      found.push_back({Overlap::Between::segments, loose[i], loose[j], contact->where});
  });
  return found;
}

std::optional<Contact> meet_segment_triangle(const Point3& p, const Point3& q, const Triangle& t) {
  return meet_with_signs(p, q, numbers::orient3d(t[0], t[1], t[2], p), numbers::orient3d(t[0], t[1], t[2], q), t);
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

// Their intersection is convex and contains the common corner. If it contains more, it reaches the opposite edge of one
// of them.
std::optional<Contact> meet_triangles_at_corner(const Triangle& s, const Triangle& t) {
  const int s1 = numbers::orient3d(t[0], t[1], t[2], s[1]), s2 = numbers::orient3d(t[0], t[1], t[2], s[2]);
  if (s1 * s2 > 0) return std::nullopt;
  const int t1 = numbers::orient3d(s[0], s[1], s[2], t[1]), t2 = numbers::orient3d(s[0], s[1], s[2], t[2]);
  if (t1 * t2 > 0) return std::nullopt;
  if (auto contact = meet_with_signs(s[1], s[2], s1, s2, t)) return contact;
  return meet_with_signs(t[1], t[2], t1, t2, s);
}

std::optional<Contact> meet_segment_at_corner(const Point3& end, const Triangle& t) {
  if (numbers::orient3d(t[0], t[1], t[2], end) != 0) return std::nullopt;
  const int axis = dominant_axis(t);
  if (holds(axis, t, end)) return Contact{end, true};
  return meet_in_plane(axis, t[0], end, t[1], t[2]);
}

std::optional<Contact> meet_segments(const Point3& p, const Point3& q, const Point3& a, const Point3& b) {
  if (numbers::orient3d(p, q, a, b) != 0) return std::nullopt;
  Point3 normal = rounded_normal({p, q, a});
  if (normal == Point3{}) normal = rounded_normal({p, q, b});
  if (normal == Point3{}) normal = cross(q - p, dominant_axis(q - p) == 0 ? Point3{0, 1, 0} : Point3{1, 0, 0});
  return meet_in_plane(dominant_axis(normal), p, q, a, b);
}

// The projection first: it rejects most points of the same plane, which are expensive for `orient3d`.
bool is_on_triangle(int axis, const Point3& p, const Triangle& t) {
  return holds(axis, t, p) && numbers::orient3d(t[0], t[1], t[2], p) == 0;
}

bool is_within_segment(const Point3& p, const Point3& a, const Point3& b) {
  return p != a && p != b && in_box_of(a, b, p) && has_no_area({a, b, p});
}

}  // namespace ccdt::plc
