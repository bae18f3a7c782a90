#pragma once

#include <cstdint>
#include <vector>

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// A face as seen from the apex of a star: the tetrahedron a b c apex is positive.
struct StarFace {
  Point3 a, b, c;
};

/// The cells around a vertex, and the opposite faces as seen from it.
struct VertexStar {
  std::vector<std::uint32_t> cells;
  std::vector<StarFace> faces;  ///< of each cell
};

/// All cells that are connected around the vertex; walls do not separate them.
void gather_cells(const CellComplex& complex, std::uint32_t vertex, CellMarks& marks,
                  std::vector<std::uint32_t>& cells);

void gather_star(const CellComplex& complex, std::uint32_t vertex, CellMarks& marks, VertexStar& star);

}  // namespace ccdt::tets
