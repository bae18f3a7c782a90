#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// Removes edges and faces of cells near a vertex, at random: where no targeted change helps, this makes others
/// possible.
///
/// \param tries   how many edges and faces to try
/// \param least   all new cells are better than this
/// \param random  with the same seed, the changes are the same on every run
/// \param made    gets the new cells; later ones may have replaced some of them
void shake_cells(CellComplex& complex, std::uint32_t vertex, int tries, double least, std::mt19937& random,
                 std::vector<CellId>& made);

}  // namespace ccdt::tets
