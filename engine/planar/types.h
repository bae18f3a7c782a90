#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/hash_table.h"
#include "engine/base/index.h"

namespace ccdt::planar {

/// What a planar triangulation asks of the plane that it lives in. Vertices are named by ids; the answers must be exact
/// and consistent. A model of this concept is chosen at compile time, so that nothing is virtual in the inner loops.
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

/// One side of an edge: the triangle, and the corner of it that the edge is opposite to.
struct Side {
  std::uint32_t triangle = 0;
  std::uint32_t corner = 0;
};

/// From vertices or edges of one facet to a position in its arrays. A facet knows only a few of the vertices of the
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
/// The two tables follow every change of the arrays.
struct Triangulation {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<std::array<std::uint32_t, 3>> neighbors;  ///< `none` across a border edge
  std::vector<std::array<bool, 3>> constrained;         ///< the edge must stay; the same seen from both sides

  Table triangle_of_vertex;  ///< vertex -> one triangle around it
  Table fixed_edges;         ///< constrained and border edges -> 3 * triangle + corner of one side
};

/// A list of triangles that is no triangulation of a part of a plane. The catcher knows the coordinates and can add the
/// place.
class Defect : public InputError {
 public:
  Defect(const std::string& what, Edge edge)
      : InputError(what, {}, "repair the facet's triangles: neighbours must share whole edges, two at most each"),
        edge_(edge) {}
  Edge edge() const { return edge_; }

 private:
  Edge edge_;
};

/// What became of a constraint.
struct ConstraintResult {
  enum class Status {
    inserted,  ///< ab is there, in `parts`
    crossing,  ///< ab crosses the constrained edge `obstacle`
    outside,   ///< ab leaves the triangulation through the border edge `obstacle`, or at a vertex (twice in `obstacle`)
  };
  Status status = Status::inserted;
  std::vector<Edge> parts;  ///< from a to b, cut by vertices on ab; unless inserted, those before the obstacle
  Edge obstacle;

  explicit operator bool() const { return status == Status::inserted; }
};

/// What is cut away from the constrained Delaunay triangulation of all vertices.
struct Carving {
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

/// A triangulation from nothing, or why there is none.
struct TriangulationResult {
  enum class Status {
    ok,
    collinear,   ///< fewer than three vertices, or all on one line
    duplicates,  ///< vertices at the same place: `duplicates`
    crossing,    ///< two edges cross: `crossing`
  };
  Status status = Status::ok;
  Triangulation triangulation;            ///< empty unless ok
  std::vector<VertexId> unused;           ///< vertices with no triangle left after carving
  std::vector<VertexId> lost_seeds;       ///< hole seeds outside all triangles
  std::vector<Edge> duplicates;           ///< pairs of vertices at the same place (equal if an id was given twice)
  std::array<std::size_t, 2> crossing{};  ///< numbers of two of the edges that cross in a point that is no vertex

  explicit operator bool() const { return status == Status::ok; }
};

}  // namespace ccdt::planar
