#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/delaunay/delaunay.h"
#include "engine/improve/cell_quality.h"
#include "engine/mesh/tet_mesh.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// A tetrahedral mesh that can be changed: cells know their neighbors, and which of their faces and edges must stay.
///
/// As in the Delaunay tetrahedralization, but without ghosts: the code of a neighbor is `no_neighbor` where there is
/// none. A *wall* is a face on a facet, of the boundary or inside. Vertices below `first_interior` are of the PLC or
/// Steiner vertices on its segments and facets; the others are ours alone and may go anywhere, or away.
struct CellComplex {
  std::vector<Point3> points;  ///< grid units
  std::uint32_t first_interior = 0;
  std::vector<std::uint32_t> cell_of_vertex;  ///< some cell that has it; `no_neighbor`: none, it is gone
  std::vector<std::uint64_t> changed_at;      ///< by vertex: the number of the last change around it

  std::vector<Cell> cells;
  std::vector<std::uint8_t> walls;         ///< by cell: bit f is set if face f is a wall
  std::vector<int> regions;                ///< by cell
  std::vector<double> worths;              ///< by cell
  std::vector<std::uint32_t> generations;  ///< by cell: how often its place was given to another
  std::vector<std::uint32_t> marks;        ///< by cell: the number of the last question that met it
  std::vector<std::uint32_t> free_cells;

  HashSet<std::uint64_t> segments;                  ///< edges that lie on segments
  HashTable<FaceKey, std::uint32_t> wall_faces;     ///< the walls: their places in `faces`
  std::vector<std::array<std::uint32_t, 3>> faces;  ///< of the mesh, on facets
  std::vector<std::uint32_t> facet_of_face;

  std::uint64_t changes = 0;    ///< so far
  std::uint32_t questions = 0;  ///< so far

  bool is_dead(std::uint32_t cell) const { return cells[cell].vertices[0] == ghost_vertex; }
  bool is_interior(std::uint32_t v) const { return v >= first_interior; }
  bool is_wall(std::uint32_t code) const { return (walls[cell_of(code)] >> face_of(code) & 1) != 0; }
  bool is_segment(std::uint32_t a, std::uint32_t b) const {
    return !is_interior(a) && !is_interior(b) && segments.contains(edge_key(a, b));
  }
  double worth_of(const QualityGoal& goal, const std::array<std::uint32_t, 4>& v) const {
    return worth(goal, points[v[0]], points[v[1]], points[v[2]], points[v[3]]);
  }
  /// The place of a vertex in a cell that has it.
  std::uint32_t place(std::uint32_t cell, std::uint32_t v) const {
    const auto& all = cells[cell].vertices;
    return all[0] == v ? 0 : all[1] == v ? 1 : all[2] == v ? 2 : 3;
  }
};

/// Exactly: is the tetrahedron positive?
bool is_positive(const CellComplex& complex, const std::array<std::uint32_t, 4>& vertices);

/// Makes a mesh ready to be changed.
///
/// \param mesh            tetrahedra, regions, faces and edges; its coordinates are not looked at
/// \param points          its vertices in grid units
/// \param facet_of_face   the facet of each of its faces: edges between faces of one facet may be exchanged
/// \param first_interior  see `CellComplex`
CellComplex make_complex(const TetMesh& mesh, std::vector<Point3> points, std::vector<std::uint32_t> facet_of_face,
                         std::uint32_t first_interior, const QualityGoal& goal);

/// Puts what became of the mesh back: tetrahedra, regions and faces. Interior vertices that are gone leave no gaps.
///
/// \return the vertices of the mesh, in grid units
std::vector<Point3> take_mesh(CellComplex&& complex, TetMesh& mesh);

}  // namespace ccdt
