#include "engine/planar/topology.h"

#include <algorithm>

#include "engine/planar/triangulation.h"

namespace ccdt {
namespace planar {
namespace {

/// Enters a constrained or border edge into the map where it is found without a search.
void register_edge(PlanarTriangulation& t, PlanarSide s) {
  if (is_constrained(t, s) || neighbor(t, s) == none) {
    t.fixed_edges.set(edge_key(edge_start(t, s), edge_end(t, s)), pack(s));
  }
}

}  // namespace

std::uint32_t corner_of(const PlanarTriangulation& t, std::uint32_t triangle, VertexId v) {
  const std::array<VertexId, 3>& corners = t.triangles[triangle];
  return corners[0] == v ? 0 : corners[1] == v ? 1 : corners[2] == v ? 2 : 3;
}

PlanarSide other_side(const PlanarTriangulation& t, PlanarSide s) {
  const std::uint32_t triangle = neighbor(t, s);
  return {triangle, next_corner(corner_of(t, triangle, edge_start(t, s)))};
}

Beyond beyond(const PlanarTriangulation& t, PlanarSide s) {
  const bool constrained = is_constrained(t, s);
  if (neighbor(t, s) == none) return {none, 0, constrained};
  const PlanarSide other = other_side(t, s);
  return {other.triangle, other.corner, constrained};
}

void attach(PlanarTriangulation& t, PlanarSide s, const Beyond& b) {
  t.neighbors[s.triangle][s.corner] = b.neighbor;
  t.constrained[s.triangle][s.corner] = b.constrained;
  if (b.neighbor != none) {
    t.neighbors[b.neighbor][b.corner] = s.triangle;
    t.constrained[b.neighbor][b.corner] = b.constrained;
  }
  register_edge(t, s);
}

void join(PlanarTriangulation& t, PlanarSide s, PlanarSide other, bool constrained) {
  attach(t, s, {other.triangle, other.corner, constrained});
}

std::uint32_t append_triangle(PlanarTriangulation& t, VertexId a, VertexId b, VertexId c) {
  const auto triangle = static_cast<std::uint32_t>(t.triangles.size());
  t.triangles.emplace_back();
  t.neighbors.push_back({none, none, none});
  t.constrained.push_back({false, false, false});
  set_corners(t, triangle, a, b, c);
  return triangle;
}

void set_corners(PlanarTriangulation& t, std::uint32_t triangle, VertexId a, VertexId b, VertexId c) {
  t.triangles[triangle] = {a, b, c};
  for (VertexId v : {a, b, c}) t.triangle_of_vertex.set(vertex_key(v), triangle);
}

std::array<PlanarSide, 4> flip(PlanarTriangulation& t, PlanarSide s) {
  const PlanarSide o = other_side(t, s);
  const VertexId a = edge_start(t, s), b = edge_end(t, s), c = apex(t, s), d = apex(t, o);
  const Beyond bc = beyond(t, {s.triangle, next_corner(s.corner)});
  const Beyond ca = beyond(t, {s.triangle, previous_corner(s.corner)});
  const Beyond ad = beyond(t, {o.triangle, next_corner(o.corner)});
  const Beyond db = beyond(t, {o.triangle, previous_corner(o.corner)});
  // c and d keep both triangles, and so whatever the map says of them; a and b lose one.
  t.triangles[s.triangle] = {c, a, d};
  t.triangles[o.triangle] = {d, b, c};
  t.triangle_of_vertex.set(vertex_key(a), s.triangle);
  t.triangle_of_vertex.set(vertex_key(b), o.triangle);
  // The triangles may be neighbours of each other across a second edge only if a vertex lies on that edge's line:
  // never.
  attach(t, {s.triangle, 2}, ca);
  attach(t, {s.triangle, 0}, ad);
  attach(t, {o.triangle, 2}, db);
  attach(t, {o.triangle, 0}, bc);
  join(t, {s.triangle, 1}, {o.triangle, 1}, false);
  return {PlanarSide{s.triangle, 0}, {s.triangle, 2}, {o.triangle, 0}, {o.triangle, 2}};
}

}  // namespace planar

using namespace planar;

PlanarTriangulation planar_from_triangles(std::span<const std::array<VertexId, 3>> triangles,
                                          std::span<const PlanarEdge> constrained_edges) {
  PlanarTriangulation t;
  t.triangles.assign(triangles.begin(), triangles.end());
  t.neighbors.assign(triangles.size(), {none, none, none});
  t.constrained.assign(triangles.size(), {false, false, false});
  t.triangle_of_vertex.reserve(triangles.size() / 2 + 3);

  const auto count = static_cast<std::uint32_t>(triangles.size());
  PlanarMap side_of_edge;  // by direction, so that each may occur once
  side_of_edge.reserve(3 * triangles.size());
  for (std::uint32_t packed = 0; packed < 3 * count; ++packed) {
    const PlanarSide s = unpack(packed);
    const VertexId from = edge_start(t, s), to = edge_end(t, s);
    if (from == to) throw PlanarDefect("a triangle of a facet has the same vertex twice", {from, to});
    if (side_of_edge.get(directed_key(from, to)) != none) {
      throw PlanarDefect("two triangles of a facet lie on the same side of an edge", {from, to});
    }
    side_of_edge.set(directed_key(from, to), packed);
    t.triangle_of_vertex.set(vertex_key(apex(t, s)), s.triangle);
  }
  for (std::uint32_t packed = 0; packed < 3 * count; ++packed) {
    const PlanarSide s = unpack(packed);
    const std::uint32_t other = side_of_edge.get(directed_key(edge_end(t, s), edge_start(t, s)));
    if (other != none) t.neighbors[s.triangle][s.corner] = other / 3;
    register_edge(t, s);
  }
  for (const auto& [a, b] : constrained_edges) {
    std::uint32_t packed = side_of_edge.get(directed_key(a, b));
    if (packed == none) packed = side_of_edge.get(directed_key(b, a));
    if (packed == none) throw PlanarDefect("a constrained edge of a facet is no edge of its triangles", {a, b});
    planar_set_constrained(t, unpack(packed), true);
  }
  return t;
}

std::optional<PlanarSide> planar_find_edge(const PlanarTriangulation& t, VertexId a, VertexId b) {
  const std::uint32_t fixed = t.fixed_edges.get(edge_key(a, b));
  if (fixed != none) {
    // An entry is not withdrawn when an edge is split or set free, so it must be looked at.
    const PlanarSide s = unpack(fixed);
    if (s.triangle < t.triangles.size() && edge_key(edge_start(t, s), edge_end(t, s)) == edge_key(a, b)) return s;
  }
  std::optional<PlanarSide> found;
  const auto has_edge = [&](std::uint32_t triangle, std::uint32_t corner) {
    const PlanarSide before{triangle, previous_corner(corner)}, after{triangle, next_corner(corner)};
    if (edge_end(t, before) == b) found = before;
    if (edge_start(t, after) == b) found = after;
    return found.has_value();
  };
  // A border edge would have been in the map, so the edge is met in every fan that it can be in: each of its ends has
  // one fan with it, and at a pinched vertex the search goes on through all triangles.
  visit_star(t, a, has_edge);
  return found;
}

bool planar_has_vertex(const PlanarTriangulation& t, VertexId v) {
  return t.triangle_of_vertex.get(vertex_key(v)) != none;
}

std::optional<PlanarSide> planar_other_side(const PlanarTriangulation& t, PlanarSide side) {
  if (neighbor(t, side) == none) return std::nullopt;
  return other_side(t, side);
}

void planar_set_constrained(PlanarTriangulation& t, PlanarSide side, bool constrained) {
  Beyond b = beyond(t, side);
  b.constrained = constrained;
  attach(t, side, b);
}

namespace {

template <class Wanted>
std::vector<PlanarEdge> collect_edges(const PlanarTriangulation& t, Wanted wanted) {
  std::vector<PlanarEdge> edges;
  for (std::uint32_t packed = 0; packed < 3 * t.triangles.size(); ++packed) {
    const PlanarSide s = unpack(packed);
    const std::uint32_t other = neighbor(t, s);
    if ((other != none && other < s.triangle) || !wanted(s)) continue;
    const VertexId from = edge_start(t, s), to = edge_end(t, s);
    edges.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

std::vector<PlanarEdge> planar_constrained_edges(const PlanarTriangulation& t) {
  return collect_edges(t, [&](PlanarSide s) { return is_constrained(t, s); });
}

std::vector<PlanarEdge> planar_border_edges(const PlanarTriangulation& t) {
  return collect_edges(t, [&](PlanarSide s) { return neighbor(t, s) == none; });
}

}  // namespace ccdt
