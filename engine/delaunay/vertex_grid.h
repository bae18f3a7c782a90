#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/base/uniform_grid.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt {

/// A vertex as the searches in the grid see it.
struct GridVertex {
  Point3 point;  ///< relative to the low corner of all points, exactly
  std::uint32_t rank = 0;
  std::uint32_t id = 0;
};

/// A cube of cells that has vertices.
struct GridBlock {
  static constexpr int side = 8;

  UniformGrid::CellIndex from{}, to{};  ///< its cells, both ends included
  Point3 centre, half;                  ///< of the box of its vertices; a hair larger
};

/// Vertices in the order of the cells of a uniform grid (paper, section 4), so that those of a row of cells lie side by
/// side: those of cell c are first[c] .. first[c + 1]. In what follows a vertex is named by its place in this order.
struct VertexGrid {
  UniformGrid grid;
  Point3 extent;  ///< of the points
  std::vector<std::uint32_t> first;
  std::vector<GridVertex> vertices;
  std::vector<GridBlock> blocks;
};

/// \param scale  factor of the paper's cell size
VertexGrid make_vertex_grid(std::span<const DelaunayVertex> vertices, double scale);

}  // namespace ccdt
