#include "bench/experiments/small_plcs/protection.h"

#include <algorithm>
#include <optional>
#include <ranges>

namespace ccdt::small {
namespace {

/// Half of a plane at an edge: a facet, seen from the edge.
struct Wing {
  Point direction;             ///< from the first end of the edge to a point of the facet
  bool inside_after = false;   ///< is the domain next to it counterclockwise, looking against the edge's direction?
  bool inside_before = false;  ///< and clockwise?
};

std::vector<Wing> wings_at(const SmallPlc& plc, const Edge& edge) {
  const Point& from = plc.vertices[edge[0]];
  std::vector<Wing> wings;
  const auto add = [&](const Polygon& facet, bool is_boundary) {
    for (const Triangle& t : triangles_of(plc, facet))
      for (unsigned i = 0; i < 3; ++i) {
        const Vertex a = t[i], b = t[(i + 1) % 3];
        if (edge_of(a, b) != edge) continue;
        // Counterclockwise of a triangle that runs along the edge is the side of its normal, the outside.
        const bool runs_along = a == edge[0];
        wings.push_back({plc.vertices[t[(i + 2) % 3]] - from, !is_boundary || !runs_along, !is_boundary || runs_along});
      }
  };
  for (const Polygon& facet : plc.boundary) add(facet, true);
  for (const Polygon& facet : plc.interior) add(facet, false);
  return wings;
}

/// Of the others the one that is next counterclockwise.
const Wing& next_wing(const Point& axis, const std::vector<Wing>& wings, const Wing& wing) {
  // Up to 180 degrees, exactly so, or above.
  const auto half = [&](const Wing& w) {
    const std::int64_t turn = determinant(axis, wing.direction, w.direction);
    return turn > 0 ? 0 : turn == 0 ? 1 : 2;
  };
  const Wing* next = nullptr;
  for (const Wing& w : wings) {
    if (&w == &wing) continue;
    const bool is_nearer = next == nullptr || half(w) < half(*next) ||
                           (half(w) == half(*next) && determinant(axis, w.direction, next->direction) > 0);
    if (is_nearer) next = &w;
  }
  return *next;
}

bool is_grazeable(const SmallPlc& plc, const Edge& edge) {
  const std::vector<Wing> wings = wings_at(plc, edge);
  if (wings.size() < 2) return true;  // a segment in the domain, or the edge of a facet that ends there
  const Point axis = plc.vertices[edge[1]] - plc.vertices[edge[0]];
  return std::ranges::any_of(wings, [&](const Wing& w) {
    return w.inside_after && determinant(axis, w.direction, next_wing(axis, wings, w).direction) <= 0;
  });
}

bool is_loose(const SmallPlc& plc, const Edge& edge) {
  return std::ranges::find(plc.segments, edge) != plc.segments.end();
}

}  // namespace

std::vector<Edge> grazeable_segments(const SmallPlc& plc) {
  std::vector<Edge> grazeable;
  for (const Edge& edge : all_segments(plc))
    if (is_grazeable(plc, edge)) grazeable.push_back(edge);
  return grazeable;
}

bool is_strongly_delaunay(const std::vector<Point>& vertices, const Edge& edge) {
  // A sphere through the origin and b is |x|^2 = w x with w b = |b|^2; a vertex c is outside if |c|^2 > w c. By
  // Motzkin's theorem no w does it for c, d and e if and only if there are l, m, n >= 0, not all zero, and k with
  // l c + m d + n e + k b = 0 and l |c|^2 + m |d|^2 + n |e|^2 + k |b|^2 <= 0. Cramer's rule gives the four numbers. (Of
  // c, d and b in a plane with the origin it gives n = 0, so that pairs need no case of their own.)
  const Point& origin = vertices[edge[0]];
  const Point b = vertices[edge[1]] - origin;
  std::vector<Point> others;
  for (Vertex v = 0; v < vertices.size(); ++v)
    if (v != edge[0] && v != edge[1]) others.push_back(vertices[v] - origin);
  const auto hinder = [&](const Point& c, const Point& d, const Point& e) {
    std::int64_t l = determinant(d, e, b), m = determinant(c, b, e), n = determinant(c, d, b);
    std::int64_t k = -determinant(c, d, e);
    if (l <= 0 && m <= 0 && n <= 0) {
      l = -l;
      m = -m;
      n = -n;
      k = -k;
    }
    if (l < 0 || m < 0 || n < 0 || l + m + n == 0) return false;
    return l * dot(c, c) + m * dot(d, d) + n * dot(e, e) + k * dot(b, b) <= 0;
  };
  for (std::size_t i = 0; i < others.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (hinder(others[i], others[j], others[k])) return false;
  return true;
}

bool is_strongly_delaunay(const std::vector<Point>& vertices, const Triangle& triangle) {
  const Point &a = vertices[triangle[0]], &b = vertices[triangle[1]], &c = vertices[triangle[2]];
  const auto is_clear = [&](const Point& d) {
    const int side = orientation(a, b, c, d);
    return std::ranges::all_of(vertices, [&](const Point& e) {
      if (e == a || e == b || e == c || e == d) return true;
      const int other_side = orientation(a, b, c, e);
      // On one side a sphere may grow away from both; of two coplanar vertices any third one tells.
      return other_side == side || side == 0 || side_of_sphere(a, b, c, d, e) < 0;
    });
  };
  return std::ranges::all_of(vertices, [&](const Point& d) { return d == a || d == b || d == c || is_clear(d); });
}

bool is_protected(const SmallPlc& plc, const Polygon& facet) {
  const Point whole = area_vector(plc, facet);
  std::int64_t filled = 0;
  for (std::size_t skipped = 0; skipped < facet.size(); ++skipped) {
    Polygon corners = facet;
    if (facet.size() > 3) corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(skipped));
    const Triangle triangle = triangle_of(corners[0], corners[1], corners[2]);
    if (is_within(plc, facet, triangle) && is_strongly_delaunay(plc.vertices, triangle))
      filled += dot(area_vector(plc, corners), whole);
    if (facet.size() == 3) break;
  }
  return filled == dot(whole, whole);
}

ProtectionState protection_of(const SmallPlc& plc) {
  const auto is_there = [&](const Edge& edge) { return is_strongly_delaunay(plc.vertices, edge); };
  const std::vector<Edge> grazeable = grazeable_segments(plc);
  return {.edges = std::ranges::all_of(grazeable, is_there),
          .all_segments = std::ranges::all_of(all_segments(plc), is_there),
          .faces = std::ranges::all_of(all_facets(plc), [&](const Polygon& f) { return is_protected(plc, f); }),
          .missing_is_loose =
              std::ranges::all_of(grazeable, [&](const Edge& e) { return is_there(e) || is_loose(plc, e); })};
}

}  // namespace ccdt::small
