#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/index.h"
#include "engine/facets/planar_map.h"

namespace ccdt {

/// What a planar triangulation asks of the plane that it lives in. Vertices are named by ids; the answers must be exact
/// and consistent. A model of this concept is chosen at compile time, so that nothing is virtual in the inner loops.
template <class P>
concept PlanarPredicates = requires(const P& p, VertexId v) {
  { p.orient(v, v, v) } -> std::convertible_to<int>;  // +1: counterclockwise, 0: collinear, -1: clockwise
  {
    p.incircle(v, v, v, v)
    } -> std::convertible_to<int>;  // for counterclockwise abc, +1: d inside the circumcircle; 0 is allowed (a tie)
};

/// An edge by its two ends, in any order.
using PlanarEdge = std::array<VertexId, 2>;

/// One side of an edge: the triangle, and the corner of it that the edge is opposite to.
struct PlanarSide {
  std::uint32_t triangle = 0;
  std::uint32_t corner = 0;
};

/// A triangulation of a part of a plane: any number of pieces, with holes, slits and pinched vertices.
///
///               2                 corners counterclockwise;
///              / \                neighbors[t][i] and constrained[t][i] belong to the edge
///   nbr[1]    /   \   nbr[0]      opposite to corner i, which runs from corner i+1 to i+2
///            / t   \              .
///           0-------1
///             nbr[2]
///
/// Whoever changes the arrays must keep the maps; the functions below do.
struct PlanarTriangulation {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< `none` across a border edge
  std::vector<std::array<bool, 3>> constrained;         ///< the edge must stay; the same seen from both sides

  PlanarMap triangle_of_vertex;  ///< vertex -> one triangle around it
  PlanarMap fixed_edges;         ///< constrained and border edges -> 3 * triangle + corner of one side
};

/// A list of triangles that is no triangulation of a part of a plane. The catcher knows the coordinates and can add the
/// place.
class PlanarDefect : public InputError {
 public:
  PlanarDefect(const std::string& what, PlanarEdge edge)
      : InputError(what, {}, "repair the facet's triangles: neighbours must share whole edges, two at most each"),
        edge_(edge) {}
  PlanarEdge edge() const { return edge_; }

 private:
  PlanarEdge edge_;
};

// ---- Topology -------------------------------------------------------------------------------------------------------

/// The triangulation that consists of these triangles, all counterclockwise in the caller's plane. Nothing is flipped.
///
/// \throw PlanarDefect  an edge with more than two triangles, or two triangles on the same side of an edge; or a
///                      constrained edge that no triangle has
PlanarTriangulation planar_from_triangles(std::span<const std::array<VertexId, 3>> triangles,
                                          std::span<const PlanarEdge> constrained_edges = {});

/// A side of the edge ab, or nothing if there is no such edge. Constant time for constrained and border edges and
/// otherwise linear in the number of triangles around a and b (around a pinched vertex, at worst: of all triangles).
std::optional<PlanarSide> planar_find_edge(const PlanarTriangulation& t, VertexId a, VertexId b);

/// Is the vertex a corner of some triangle?
bool planar_has_vertex(const PlanarTriangulation& t, VertexId v);

/// The same edge seen from its other triangle; nothing at the border.
std::optional<PlanarSide> planar_other_side(const PlanarTriangulation& t, PlanarSide side);

/// Forbids or allows the edge to be flipped, seen from both its sides.
void planar_set_constrained(PlanarTriangulation& t, PlanarSide side, bool constrained);

/// All constrained edges and all border edges, each once, the smaller id first, sorted.
std::vector<PlanarEdge> planar_constrained_edges(const PlanarTriangulation& t);
std::vector<PlanarEdge> planar_border_edges(const PlanarTriangulation& t);

// ---- Geometry -------------------------------------------------------------------------------------------------------
// All triangles must be strictly counterclockwise by `predicates.orient`.

/// Flips unconstrained inner edges until each is locally Delaunay: the triangulation becomes the constrained Delaunay
/// triangulation (Lawson 1977). A tie (`incircle` 0) leaves the edge; without ties the result is unique. Ends if the
/// predicates are exact. \return how many edges were flipped
template <PlanarPredicates P>
std::size_t planar_legalize(PlanarTriangulation& t, const P& predicates);

/// Inserts the vertex v, which lies exactly on the edge ab, strictly between its ends, and legalizes around it. The
/// halves of the edge inherit its constraint. If the triangulation was constrained Delaunay, it is so again. \return
/// false, and nothing has changed, if ab is no edge of the triangulation
template <PlanarPredicates P>
bool planar_split_edge(PlanarTriangulation& t, VertexId a, VertexId b, VertexId v, const P& predicates);

/// Inserts the vertex v wherever it lies (within a triangle or on an edge) and legalizes around it.
/// \param near  a vertex of the triangulation not far away, where the search starts; none: anywhere
/// \return what happened; on `outside` and `on_vertex` nothing has changed
enum class PlanarInsertion { inserted, on_vertex, outside };
template <PlanarPredicates P>
PlanarInsertion planar_insert_vertex(PlanarTriangulation& t, VertexId v, const P& predicates,
                                     VertexId near = VertexId());

/// What became of a constraint.
struct PlanarConstraintResult {
  enum class Status {
    inserted,  ///< ab is there, in `parts`
    crossing,  ///< ab crosses the constrained edge `obstacle`
    outside,   ///< ab leaves the triangulation through the border edge `obstacle`, or at the vertex obstacle[0] ==
               ///< obstacle[1]
  };
  Status status = Status::inserted;
  std::vector<PlanarEdge>
      parts;  ///< from a to b, as cut by vertices on ab; unless inserted, the parts before the obstacle
  PlanarEdge obstacle;

  explicit operator bool() const { return status == Status::inserted; }
};

/// Makes ab a constrained edge, or a chain of such where vertices lie exactly on it, and legalizes around it. a and b
/// must be different vertices of the triangulation.
template <PlanarPredicates P>
PlanarConstraintResult planar_insert_constraint(PlanarTriangulation& t, VertexId a, VertexId b, const P& predicates);

// ---- From nothing ---------------------------------------------------------------------------------------------------

/// What is cut away from the constrained Delaunay triangulation of all vertices.
struct PlanarCarving {
  enum class Outside {
    keep,     ///< the convex hull of the vertices stays
    remove,   ///< what the border of the convex hull reaches without crossing a constraint goes
    nesting,  ///< polygons: of the regions nested in each other, outermost first, every second one stays (even-odd)
  };
  Outside outside = Outside::remove;
  /// Points in holes, each known to `predicates.orient` as a vertex, but not one of the vertices: what each reaches
  /// without crossing a constraint goes.
  std::vector<VertexId> hole_seeds;
};

struct PlanarTriangulationResult {
  enum class Status {
    ok,
    collinear,   ///< fewer than three vertices, or all on one line
    duplicates,  ///< vertices at the same place: `duplicates`
    crossing,    ///< two edges cross: `crossing`
  };
  Status status = Status::ok;
  PlanarTriangulation triangulation;      ///< empty unless ok
  std::vector<VertexId> unused;           ///< vertices with no triangle left after carving
  std::vector<VertexId> lost_seeds;       ///< hole seeds outside all triangles
  std::vector<PlanarEdge> duplicates;     ///< pairs of vertices at the same place (equal if an id was given twice)
  std::array<std::size_t, 2> crossing{};  ///< numbers of two of the edges that cross in a point that is no vertex

  explicit operator bool() const { return status == Status::ok; }
};

/// The constrained Delaunay triangulation of vertices and edges. Divide and conquer after Guibas & Stolfi (1985), in
/// the order in which a corner of the convex hull sees the vertices, so that no coordinates are needed: O(n log n) for
/// any input. Then the edges are inserted one by one and the rest is carved.
///
/// Vertices on edges split them; edges may overlap and repeat; an edge from a vertex to itself counts for nothing.
/// \throw std::invalid_argument  an edge's end that is not among the vertices
template <PlanarPredicates P>
PlanarTriangulationResult planar_triangulate(std::span<const VertexId> vertices, std::span<const PlanarEdge> edges,
                                             const P& predicates, const PlanarCarving& carving = {});

/// The Delaunay triangulation of the convex hull of the vertices; `triangulation` is all of the result.
template <PlanarPredicates P>
PlanarTriangulationResult planar_delaunay(std::span<const VertexId> vertices, const P& predicates);

}  // namespace ccdt

// The bodies of the templates.
#include "engine/facets/planar_constraint.h"
#include "engine/facets/planar_delaunay.h"
#include "engine/facets/planar_legalize.h"
#include "engine/facets/planar_triangulate.h"
