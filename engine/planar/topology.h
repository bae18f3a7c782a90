#pragma once

#include "engine/base/simplex_map.h"
#include "engine/planar/types.h"

/// The steps that the planar algorithms are made of: they change triangles and keep neighbors, constraints and tables,
/// and know nothing of geometry.
namespace ccdt::planar {

constexpr std::uint32_t none = Triangulation::none;

constexpr std::uint32_t next_corner(std::uint32_t corner) {
  return corner == 2 ? 0 : corner + 1;
}
constexpr std::uint32_t previous_corner(std::uint32_t corner) {
  return corner == 0 ? 2 : corner - 1;
}

/// A side as one number: 3 * triangle + corner.
constexpr std::uint32_t pack(Side s) {
  return 3 * s.triangle + s.corner;
}
constexpr Side unpack(std::uint32_t packed) {
  return {packed / 3, packed % 3};
}

constexpr std::uint64_t directed_key(VertexId from, VertexId to) {
  return (std::uint64_t{from.value} << 32) | to.value;
}

/// Start and end of the edge, with the triangle on its left.
inline VertexId edge_start(const Triangulation& t, Side s) {
  return t.triangles[s.triangle][next_corner(s.corner)];
}
inline VertexId edge_end(const Triangulation& t, Side s) {
  return t.triangles[s.triangle][previous_corner(s.corner)];
}
inline VertexId apex(const Triangulation& t, Side s) {
  return t.triangles[s.triangle][s.corner];
}
inline std::uint32_t neighbor(const Triangulation& t, Side s) {
  return t.neighbors[s.triangle][s.corner];
}
inline bool is_constrained(const Triangulation& t, Side s) {
  return t.constrained[s.triangle][s.corner];
}

/// The corner of a triangle that has the vertex; 3 if none has.
std::uint32_t corner_of(const Triangulation& t, std::uint32_t triangle, VertexId v);

/// The same edge seen from its other triangle, which must exist.
Side other_side(const Triangulation& t, Side s);

/// What is across one edge of a triangle that is about to be rewritten.
struct Adjacency {
  std::uint32_t neighbor = none;
  std::uint32_t corner = 0;  ///< of the neighbor, opposite to the edge
  bool constrained = false;
};
Adjacency adjacency_at(const Triangulation& t, Side s);

/// Joins the side to what is across it, from both sides, and enters the edge into the tables.
void attach(Triangulation& t, Side s, const Adjacency& across);

/// Joins two sides of one edge as an inner edge.
void join(Triangulation& t, Side s, Side other, bool constrained);

/// Appends a triangle without neighbors.
std::uint32_t append_triangle(Triangulation& t, VertexId a, VertexId b, VertexId c);

/// Rewrites the corners of a triangle and enters them into the table of vertices.
void set_corners(Triangulation& t, std::uint32_t triangle, VertexId a, VertexId b, VertexId c);

/// Replaces an inner edge by the other diagonal of its two triangles; returns the four outer edges of the two, each
/// seen from inside.
///
///        c                  c
///      /   \              / | \       the triangle of `s` is abc with the edge ab,
///     a --- b    ->      a  |  b      afterwards it is cad, its neighbor dbc
///      \   /              \ | /
///        d                  d
std::array<Side, 4> flip(Triangulation& t, Side s);

/// Puts as many new triangles in the place of the channel's and joins them to each other and to what was around.
/// \param border  the sides of the channel's triangles that are not crossed
void replace_channel(Triangulation& t, const std::vector<std::uint32_t>& channel, const std::vector<Side>& border,
                     const std::vector<std::array<VertexId, 3>>& triangles);

/// Calls visit(triangle, corner of v) for the triangles around v that hang together with the known one, until it
/// returns true; returns whether it did. At a pinched vertex these need not be all.
template <class Visit>
bool visit_fan(const Triangulation& t, VertexId v, Visit visit) {
  const std::uint32_t first = t.triangle_of_vertex.get(v, none);
  if (first == none) return false;
  std::uint32_t triangle = first;
  do {  // counterclockwise
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (visit(triangle, corner)) return true;
    triangle = t.neighbors[triangle][next_corner(corner)];
  } while (triangle != none && triangle != first);
  if (triangle == first) return false;
  triangle = t.neighbors[first][previous_corner(corner_of(t, first, v))];
  while (triangle != none) {  // a border was met: clockwise from the start as well
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (visit(triangle, corner)) return true;
    triangle = t.neighbors[triangle][previous_corner(corner)];
  }
  return false;
}

/// The same for all triangles around v: at a pinched vertex all triangles are searched if the first fan has no answer.
template <class Visit>
bool visit_star(const Triangulation& t, VertexId v, Visit visit) {
  bool at_border = false;
  const auto noting_borders = [&](std::uint32_t triangle, std::uint32_t corner) {
    at_border |= t.neighbors[triangle][next_corner(corner)] == none;
    return visit(triangle, corner);
  };
  if (visit_fan(t, v, noting_borders)) return true;
  if (!at_border) return false;
  for (std::uint32_t triangle = 0; triangle < t.triangles.size(); ++triangle) {
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (corner < 3 && visit(triangle, corner)) return true;
  }
  return false;
}

/// Keeps the triangles with a true mark only; edges to the others become border edges.
Triangulation keep_triangles(const Triangulation& t, const std::vector<bool>& keep);

/// Marks for `keep_triangles` after the wish for the outside (see `Carving`).
std::vector<bool> choose_inside(const Triangulation& t, Carving::Outside outside);

/// Takes the marks from all triangles that the seed triangle reaches without crossing a constraint.
void flood_hole(const Triangulation& t, std::uint32_t seed, std::vector<bool>& keep);

}  // namespace ccdt::planar
