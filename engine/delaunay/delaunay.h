#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/base/progress.h"

namespace ccdt::delaunay {

/// A vertex of the tetrahedralization. Its rank, its place in the order of insertion, is given once and decides ties.
struct DelaunayVertex {
  Point3 point;
  std::uint32_t rank = 0;
  std::uint32_t cell = 0;  ///< some cell that has this vertex
};

/// A tetrahedron, or a *ghost*: a face of the convex hull joined to the vertex at infinity.
///
/// Vertices are positively oriented: vertex 3 is above the triangle 0 1 2. Face i is opposite to vertex i. A ghost has
/// `ghost_vertex` as vertex 3; the outside of the hull is above its triangle 0 1 2.
/// A neighbor is a face code, 4 * cell + face: the same face as the cell on its other side calls it.
struct Cell {
  std::array<std::uint32_t, 4> vertices;
  std::array<std::uint32_t, 4> neighbors;
};

inline constexpr std::uint32_t ghost_vertex = VertexId::none_value;
inline constexpr std::uint32_t no_neighbor = 0xFFFFFFFFu;

constexpr std::uint32_t face_code(std::uint32_t cell, std::uint32_t face) {
  return 4 * cell + face;
}
constexpr std::uint32_t cell_of(std::uint32_t code) {
  return code >> 2;
}
constexpr std::uint32_t face_of(std::uint32_t code) {
  return code & 3;
}

/// The corners of face i, such that the vertex i is above them.
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> face_corners = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// The Delaunay tetrahedralization of points on the dyadic grid, unique by perturbation (predicates.h). A plain flat
/// structure: cells and vertices are indices into arrays. Cells whose place waits to be used again are dead.
struct Delaunay {
  std::vector<DelaunayVertex> vertices;  ///< by id
  std::vector<Cell> cells;
  std::vector<std::uint32_t> free_cells;  ///< places of dead cells

  const Point3& point(std::uint32_t v) const { return vertices[v].point; }
  bool is_dead(std::uint32_t cell) const { return cells[cell].neighbors[0] == no_neighbor; }
  bool is_ghost(std::uint32_t cell) const { return cells[cell].vertices[3] == ghost_vertex; }
  bool is_finite(std::uint32_t cell) const { return !is_dead(cell) && !is_ghost(cell); }
};

/// Tetrahedralizes points, which get their indices as ids. Incremental insertion (Bowyer, Watson) in the order of a
/// Hilbert curve.
///
/// \param points  grid units, pairwise different
/// \throw MeshError  fewer than four points, or all in one plane; carries no place
Delaunay build_delaunay(std::span<const Point3> points, const Progress& progress = {});

/// The ranks, by id, that `build_delaunay` gives: the order of its insertions.
///
/// \throw MeshError  as build_delaunay
std::vector<std::uint32_t> insertion_ranks(std::span<const Point3> points);

/// Throws what `build_delaunay` throws for points without a body.
[[noreturn]] void refuse_flat_points();

}  // namespace ccdt::delaunay
