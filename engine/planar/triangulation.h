#pragma once

#include <array>
#include <optional>
#include <span>

#include "engine/planar/topology.h"

namespace ccdt::planar {

// ---- Topology -------------------------------------------------------------------------------------------------------

/// The triangulation that consists of these triangles, all counterclockwise in the caller's plane. Nothing is flipped.
///
/// \param room  memory is reserved for this many more triangles
/// \throw InputError  an edge with more than two triangles, or two triangles on the same side of an edge; or a
///                    constrained edge that no triangle has
Triangulation from_triangles(std::span<const std::array<VertexId, 3>> triangles,
                             std::span<const Edge> constrained_edges = {}, std::size_t room = 0);

/// A side of the edge ab, or nothing if there is no such edge. Constant time for constrained and border edges and
/// otherwise linear in the number of triangles around a and b (around a pinched vertex, at worst: of all triangles).
std::optional<Side> find_edge(const Triangulation& t, VertexId a, VertexId b);

/// Is the vertex a corner of some triangle?
bool has_vertex(const Triangulation& t, VertexId v);

/// Forbids or allows the edge to be flipped, seen from both its sides.
void set_constrained(Triangulation& t, Side side, bool constrained);

/// All border edges, each once, the smaller id first, sorted.
std::vector<Edge> border_edges(const Triangulation& t);

// ---- Geometry -------------------------------------------------------------------------------------------------------
// All triangles must be strictly counterclockwise by `predicates.orient`.

/// Flips unconstrained inner edges until each is locally Delaunay: the triangulation becomes the constrained Delaunay
/// triangulation (Lawson 1977). A tie (`incircle` 0) leaves the edge; without ties the result is unique. It terminates
/// if the predicates are exact.
template <Predicates P>
void legalize(Triangulation& t, const P& predicates);

/// Inserts the vertex v, which lies exactly on the edge ab, strictly between its ends, and legalizes around it. The
/// halves of the edge inherit its constraint. If the triangulation was constrained Delaunay, it is so again.
///
/// \return false, and nothing has changed, if ab is not an edge of the triangulation
template <Predicates P>
bool split_edge(Triangulation& t, VertexId a, VertexId b, VertexId v, const P& predicates);

/// Makes ab a constrained edge, or a chain of these where vertices lie exactly on it, and legalizes around it. a and b
/// must be distinct vertices of the triangulation.
template <Predicates P>
ConstraintResult insert_constraint(Triangulation& t, VertexId a, VertexId b, const P& predicates);

// ---- From scratch ---------------------------------------------------------------------------------------------------

/// The constrained Delaunay triangulation of vertices and edges. Divide and conquer after Guibas & Stolfi (1985), in
/// the order in which a corner of the convex hull sees the vertices, so that no coordinates are needed: O(n log n) for
/// any input. Then the edges are inserted one by one and the rest is carved.
///
/// Vertices on edges split them; edges may overlap and repeat; an edge from a vertex to itself counts for nothing.
/// \throw std::invalid_argument  an edge's end is not among the vertices
template <Predicates P>
TriangulationResult triangulate(std::span<const VertexId> vertices, std::span<const Edge> edges, const P& predicates,
                                const Carving& carving = {});

/// The Delaunay triangulation of the convex hull of the vertices; only `triangulation` of the result is used.
template <Predicates P>
TriangulationResult delaunay(std::span<const VertexId> vertices, const P& predicates);

}  // namespace ccdt::planar

// The bodies of the templates.
#include "engine/planar/constraints.h"
#include "engine/planar/delaunay.h"
