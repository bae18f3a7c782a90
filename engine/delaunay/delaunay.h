#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/index.h"
#include "engine/base/platform.h"
#include "engine/base/progress.h"
#include "engine/base/raw_vector.h"
#include "engine/geometry/filters.h"

namespace ccdt::delaunay {

/// A vertex of the tetrahedralization. Its rank, which is its place in the order of insertion, is fixed and decides
/// ties. Nothing in it changes, so threads may load it as a whole.
struct alignas(32) DelaunayVertex {
  Point3 point;
  std::uint32_t rank = 0;
};

/// All threads set up vertices, so no thread clears them first.
using DelaunayVertices = RawVector<DelaunayVertex>;

/// The coordinates; the fourth lane may hold anything.
CCDT_ALWAYS_INLINE void load(const DelaunayVertex& v, Lanes& result) {
  static_assert(sizeof v == sizeof result);
  std::memcpy(&result, &v, sizeof result);
}

/// \return  `empty_box` if there are no vertices
inline Box bounding_box(std::span<const DelaunayVertex> vertices) {
  Box box = empty_box;
  for (const DelaunayVertex& v : vertices) box = hull(box, box_of(v.point));
  return box;
}

/// A tetrahedron, or a *ghost*: a face of the convex hull joined to the vertex at infinity.
///
/// Vertices are positively oriented: vertex 3 is above the triangle 0 1 2. Face i is opposite vertex i. A ghost has
/// `ghost_vertex` as vertex 3; the outside of the hull is above its triangle 0 1 2. A neighbor is a face code, 4 * cell
/// + face: the same face, numbered in the cell on its other side.
struct Cell {
  std::array<std::uint32_t, 4> vertices;
  std::array<std::uint32_t, 4> neighbors;
};

inline constexpr std::uint32_t ghost_vertex = none;
inline constexpr std::uint32_t no_neighbor = none;

constexpr std::uint32_t face_code(std::uint32_t cell, std::uint32_t face) {
  return 4 * cell + face;
}
constexpr std::uint32_t cell_of(std::uint32_t code) {
  return code >> 2;
}
constexpr std::uint32_t face_of(std::uint32_t code) {
  return code & 3;
}

/// The corners of face i, in an order with vertex i above them.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_corners = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// The corners of face f of a cell with these vertices, in the order of `face_corners`.
constexpr std::array<std::uint32_t, 3> corners_of_face(const std::array<std::uint32_t, 4>& v, std::uint32_t f) {
  const auto& corner = face_corners[f];
  return {v[corner[0]], v[corner[1]], v[corner[2]]};
}

/// The ends of each edge of a cell and its other two corners, in positive orientation.
inline constexpr std::array<std::array<std::uint8_t, 4>, 6> edge_corners = {
    {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};

/// Makes two cells neighbors across the face with code a in one and code b in the other.
inline void join_faces(LargeVector<Cell>& cells, std::uint32_t a, std::uint32_t b) {
  cells[cell_of(a)].neighbors[face_of(a)] = b;
  cells[cell_of(b)].neighbors[face_of(b)] = a;
}

/// The Delaunay tetrahedralization of points on the dyadic grid, unique by perturbation (predicates.h). A flat
/// structure: cells and vertices are indices into arrays. Cells whose place can be reused are dead.
struct Delaunay {
  DelaunayVertices vertices;         ///< by id
  RawVector<std::uint32_t> cell_at;  ///< by vertex: a cell with it; `none` if it waits to be inserted
  LargeVector<Cell> cells;
  std::vector<std::uint32_t> free_cells;  ///< places of dead cells

  const Point3& point(std::uint32_t v) const { return vertices[v].point; }
  /// Adds a vertex that waits to be inserted. Its rank is its id.
  std::uint32_t add_vertex(const Point3& p) {
    const auto v = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back({p, v});
    cell_at.push_back(none);
    return v;
  }
  /// Takes back the last vertex that was added, which still waits.
  void remove_last_vertex() { vertices.pop_back(), cell_at.pop_back(); }
  /// The code of the same face in the cell on its other side.
  std::uint32_t across(std::uint32_t code) const { return cells[cell_of(code)].neighbors[face_of(code)]; }
  /// Prefetches the cell of a code some places after the i-th, before it is needed. Codes may be `no_neighbor`.
  void prefetch_after(std::size_t i, std::span<const std::uint32_t> codes) const {
    constexpr std::size_t ahead = 16;
    if (i + ahead < codes.size()) prefetch(cells.data() + cell_of(codes[i + ahead]));
  }
  bool is_dead(std::uint32_t cell) const { return cells[cell].neighbors[0] == no_neighbor; }
  bool is_ghost(std::uint32_t cell) const { return cells[cell].vertices[3] == ghost_vertex; }
  bool is_finite(std::uint32_t cell) const { return !is_dead(cell) && !is_ghost(cell); }
};

/// Tetrahedralizes points, whose ids are their indices, by incremental insertion (Bowyer, Watson) in the order of a
/// Hilbert curve.
///
/// \param points  grid units, distinct
/// \param first   indices of points whose ranks are the least, in this order, except for the four that insertion begins
///                with: the first ones that are not in one plane
/// \throw MeshError  fewer than four points, or all in one plane; carries no place
Delaunay build_delaunay(std::span<const Point3> points, const Progress& progress = {},
                        std::span<const std::uint32_t> first = {});

/// The ranks, by id, that `build_delaunay` assigns: the order of its insertions.
///
/// \throw MeshError  as in build_delaunay
std::vector<std::uint32_t> insertion_ranks(std::span<const Point3> points);

/// Throws what `build_delaunay` throws for points without a body.
[[noreturn]] void refuse_flat_points();

/// Tetrahedralizes points face by face, as in the paper (sections 4 and 5: the uniform grid construction of Fang and
/// Piegl 1993, in space). Starting with a face of the hull, a search in the uniform grid finds the tetrahedron on the
/// open side of each face. The cells are the same as with insertion in the order of ranks.
///
/// The time is about linear for points of uniform density in a body. It is not if the points are graded or lie only on
/// surfaces, because the number of vertices in a grid cell is then unbounded: a region k times as dense as the mean
/// takes about k times as long per vertex; n points on a sphere take about n^2. On slanted flat sides, where rounding
/// moves vertices off the plane, the spheres of slivers are nearly half-spaces, and their border is searched: about
/// n^1.2 in all.
///
/// \param vertices    by id, with distinct points, in grid units, and distinct ranks
/// \param grid_scale  factor of the paper's cell size
/// \return  without dead cells
/// \throw MeshError  as in build_delaunay
Delaunay wrap_delaunay(DelaunayVertices vertices, double grid_scale = 1, const Progress& progress = {});

/// Adds points as vertices, in the order of a Hilbert curve. Their ids, and their ranks too, follow the existing ones.
/// They have no cells yet: `insert_vertices` adds cells for them, or `wrap_delaunay` makes all cells anew.
///
/// \param points        grid units
/// \param later_rounds  as for `hilbert_order`
/// \return  by added vertex, the index of its point
std::vector<std::uint32_t> append_vertices(Delaunay& d, std::span<const Point3> points,
                                           std::span<const std::uint8_t> later_rounds = {});

/// Adds points to the tetrahedralization, as `append_vertices` and `insert_vertices` do.
///
/// \param points  grid units, distinct, and none at a vertex
void insert_points(Delaunay& d, std::span<const Point3> points, std::span<const std::uint8_t> later_rounds = {},
                   const Progress& progress = {});

/// The place of v among the vertices of the cell; 4 if it is not there. It is unpredictable, so there is no branch.
inline std::uint32_t place_of(const Cell& cell, std::uint32_t v) {
  const auto& u = cell.vertices;
  return 4 - 4 * unsigned{u[0] == v} - 3 * unsigned{u[1] == v} - 2 * unsigned{u[2] == v} - unsigned{u[3] == v};
}

/// Walks around the edge ab, from one of its cells to the next.
///
/// \param first  the cell to begin with
/// \param visit  visit(cell, exit, staying): the walk leaves the cell through the face opposite the vertex at the place
///               `exit`; the vertex at `staying` is the other one not on the edge. False ends the walk
template <class Visit>
void walk_around_edge(const Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t first, const Visit& visit) {
  std::uint32_t here = first, exit = 0;
  while (d.cells[first].vertices[exit] == a || d.cells[first].vertices[exit] == b) ++exit;
  do {
    const Cell& cell = d.cells[here];
    // The four places add up to 6.
    const std::uint32_t staying = 6 - place_of(cell, a) - place_of(cell, b) - exit, v = cell.vertices[staying];
    if (!visit(here, exit, staying)) return;
    here = cell_of(cell.neighbors[exit]);
    exit = place_of(d.cells[here], v);
  } while (here != first);
}

/// The points of the vertices.
std::vector<Point3> points_of(const Delaunay& d);

/// A cell at the vertex a that contains the beginning of the straight line from a to p; p is in the convex hull.
///
/// \param b  the vertex at p, if there is one: then any cell at a that has it will do
std::uint32_t cell_toward(const Delaunay& d, std::uint32_t a, const Point3& p, std::uint32_t b = ghost_vertex);

/// A cell that has the edge ab; `no_neighbor` if this is not an edge of the tetrahedralization.
std::uint32_t find_edge(const Delaunay& d, std::uint32_t a, std::uint32_t b);

/// Is ab an edge of the tetrahedralization?
inline bool has_edge(const Delaunay& d, std::uint32_t a, std::uint32_t b) {
  return find_edge(d, a, b) != no_neighbor;
}

/// The code of the face abc in the cell above it (from where abc is counterclockwise); `no_neighbor` if it is not a
/// face.
///
/// \param at_edge  the result of `find_edge` for ab
std::uint32_t find_face(const Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t at_edge);
inline std::uint32_t find_face(const Delaunay& d, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return find_face(d, a, b, c, find_edge(d, a, b));
}

/// Visits the cells around vertices. It owns the marks for this, so create it once and reuse it.
class CellStar {
 public:
  explicit CellStar(const Delaunay& delaunay) : d_(delaunay) {}

  /// All cells, finite and ghost, that have the vertex; valid until the next call.
  std::span<const std::uint32_t> around(std::uint32_t vertex);

 private:
  const Delaunay& d_;
  std::vector<std::uint32_t> seen_;  // the number of the last search that reached the cell
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> cells_;
};

}  // namespace ccdt::delaunay
