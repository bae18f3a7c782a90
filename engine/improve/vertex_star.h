#pragma once

#include <cstdint>
#include <vector>

#include "engine/improve/cell_complex.h"
#include "engine/improve/move_apex.h"

namespace ccdt {

/// The cells around a vertex, and the faces opposite to it, as it sees them.
struct VertexStar {
  std::vector<std::uint32_t> cells;
  std::vector<StarFace> faces;  ///< of each cell
};

/// All cells that hang together around the vertex; walls do not part them.
void gather_cells(CellComplex& complex, std::uint32_t vertex, std::vector<std::uint32_t>& cells);

void gather_star(CellComplex& complex, std::uint32_t vertex, VertexStar& star);

}  // namespace ccdt
