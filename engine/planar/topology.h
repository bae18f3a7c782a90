#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/hash_table.h"
#include "engine/base/index.h"
#include "engine/base/simplex_map.h"

namespace ccdt::planar {

/// The predicates that a planar triangulation needs. Vertices are named by ids; the answers must be exact and
/// consistent. The model of this concept is chosen at compile time, so that no call in the inner loops is virtual.
///
/// `orient(a, b, c)`       +1: counterclockwise, 0: collinear, -1: clockwise
/// `incircle(a, b, c, d)`  for counterclockwise abc, +1: d inside the circumcircle, -1: outside; 0 is allowed (a tie)
template <class P>
concept Predicates = requires(const P& p, VertexId v) {
  { p.orient(v, v, v) } -> std::convertible_to<int>;
  { p.incircle(v, v, v, v) } -> std::convertible_to<int>;
};

/// An edge by its two ends, in any order.
using Edge = std::array<VertexId, 2>;

/// One side of an edge: the triangle, and its corner opposite the edge.
struct Side {
  std::uint32_t triangle = 0;
  std::uint32_t corner = 0;
};

/// Maps a vertex or edge of one facet to a position in its arrays. A facet knows only a few of the vertices of the
/// whole complex, so it cannot afford an array over all ids.
using Table = HashTable<std::uint64_t, std::uint32_t>;

/// A triangulation of a part of a plane: any number of pieces, with holes, slits and pinched vertices.
///
///               2                 corners counterclockwise;
///              / \                neighbors[t][i] and constrained[t][i] belong to the edge
///   nbr[1]    /   \   nbr[0]      opposite to corner i, which runs from corner i+1 to i+2
///            / t   \              .
///           0-------1
///             nbr[2]
///
/// The two tables are updated with every change of the arrays.
struct Triangulation {
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< `none` across a border edge
  std::vector<std::array<bool, 3>> constrained;         ///< the edge must stay; the same seen from both sides

  Table triangle_of_vertex;  ///< vertex -> one triangle around it
  Table known_edges;  ///< edges, among them all constrained and border edges -> 3 * triangle + corner of one side
};

/// The result of inserting a constraint.
struct ConstraintResult {
  bool inserted = true;
  std::vector<Edge> parts;  ///< from a to b, cut by vertices on ab; unless inserted, those before the obstacle
  Edge obstacle;  ///< unless inserted: the constrained or border edge that ab crosses, or twice the vertex where it
                  ///< leaves the triangulation
};

/// What to remove from the constrained Delaunay triangulation of all vertices.
struct Carving {
  /// Polygons: of the regions nested in each other, outermost first, every second one stays (even-odd). If not nested,
  /// only what is reachable from the border of the convex hull without crossing a constraint is removed.
  bool nested = false;
  /// Points in holes, each known to `predicates.orient` as a vertex, but not one of the vertices: everything reachable
  /// from it without crossing a constraint is removed.
  std::vector<VertexId> hole_seeds;
};

/// A new triangulation, or the reason why there is none.
struct TriangulationResult {
  enum class Status {
    ok,
    collinear,   ///< fewer than three vertices, or all on one line
    duplicates,  ///< vertices at the same place
    crossing,    ///< two edges cross: `crossing`
  };
  Status status = Status::ok;
  Triangulation triangulation;            ///< empty unless ok
  std::vector<VertexId> unused;           ///< vertices with no triangle left after carving
  std::vector<VertexId> lost_seeds;       ///< hole seeds outside all triangles
  std::array<std::size_t, 2> crossing{};  ///< numbers of two edges that cross in a point that is not a vertex

  explicit operator bool() const { return status == Status::ok; }
};

// ---- Steps ----------------------------------------------------------------------------------------------------------
// The planar algorithms are made of these. They change triangles, keep neighbors, constraints and tables up to date,
// and use no geometry.

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

/// The other side of an edge of a triangle that is about to be rewritten.
struct Adjacency {
  std::uint32_t neighbor = none;
  std::uint32_t corner = 0;  ///< of the neighbor, opposite to the edge
  bool constrained = false;
};
Adjacency adjacency_at(const Triangulation& t, Side s);

/// Joins the side to its other side, in both directions, and enters the edge into the tables.
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

/// Replaces the triangles of the channel by equally many new ones, and joins them to each other and to their
/// surroundings.
/// \param border  the sides of the channel's triangles that are not crossed
void replace_channel(Triangulation& t, const std::vector<std::uint32_t>& channel, const std::vector<Side>& border,
                     const std::vector<std::array<VertexId, 3>>& triangles);

/// Calls visit(triangle, corner of v) for the triangles around v that are connected with the known one, until it
/// returns true. \return did it return true? At a pinched vertex these need not be all.
template <class Visit>
bool visit_fan(const Triangulation& t, VertexId v, Visit visit) {
  const std::uint32_t first = t.triangle_of_vertex.get(v, none);
  if (first == none) return false;
  std::uint32_t triangle = first;
  do {  // counterclockwise
    ++work_done.triangles_visited;
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (visit(triangle, corner)) return true;
    triangle = t.neighbors[triangle][next_corner(corner)];
  } while (triangle != none && triangle != first);
  if (triangle == first) return false;
  triangle = t.neighbors[first][previous_corner(corner_of(t, first, v))];
  while (triangle != none) {  // a border was met: clockwise from the start as well
    ++work_done.triangles_visited;
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (visit(triangle, corner)) return true;
    triangle = t.neighbors[triangle][previous_corner(corner)];
  }
  return false;
}

/// The same for all triangles around v: at a pinched vertex, all triangles are searched if the first fan has no answer.
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
    ++work_done.triangles_visited;
    const std::uint32_t corner = corner_of(t, triangle, v);
    if (corner < 3 && visit(triangle, corner)) return true;
  }
  return false;
}

/// Keeps only the triangles with a true mark; edges to the others become border edges.
Triangulation keep_triangles(const Triangulation& t, const std::vector<bool>& keep);

/// Marks for `keep_triangles` according to the carving (see `Carving`).
std::vector<bool> choose_inside(const Triangulation& t, bool nested);

/// Clears the marks of all triangles that are reachable from the seed triangle without crossing a constraint.
void flood_hole(const Triangulation& t, std::uint32_t seed, std::vector<bool>& keep);

}  // namespace ccdt::planar
