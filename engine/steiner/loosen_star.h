#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "engine/tets/cell_set.h"

namespace ccdt::steiner {

using tets::CellComplex, tets::CellSet, tets::Change;

/// The state of loosening. The changes are random, but the same on every run.
struct Loosening {
  std::mt19937 random{2};
  std::vector<CellId> new_cells;  ///< since the last `tidy_star`; some may be dead

  // Working memory.
  CellSet star;
  Change change, scratch;
  std::vector<CellId> made;
};

/// Changes the cells around a vertex that cannot be removed from a segment, so that the next attempt meets other cells:
/// removes edges and faces near it at random, whatever the quality, and then as many edges of the vertex as possible. A
/// vertex with fewer edges is easier to remove.
///
/// \param shakes  how many edges and faces to try
void loosen_star(CellComplex& complex, std::uint32_t vertex, int shakes, Loosening& state);

/// Makes bad cells better by swaps: those around the vertex and those that loosening has made.
void tidy_star(CellComplex& complex, std::uint32_t vertex, Loosening& state);

}  // namespace ccdt::steiner
