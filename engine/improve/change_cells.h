#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/improve/cell_complex.h"

namespace ccdt {

/// A cell to be made.
struct NewCell {
  std::array<std::uint32_t, 4> vertices;  ///< positively oriented
  int region;
  double worth;
};

/// The diagonal ab of two triangles on a facet gives way to the other one, cd.
struct FacetFlip {
  std::uint32_t a, b, c, d;
};

/// Cells and those that fill the same space instead.
struct Change {
  std::vector<std::uint32_t> old_cells;
  std::vector<NewCell> new_cells;
  std::vector<FacetFlip> flips;  ///< one at most

  void clear() {
    old_cells.clear();
    new_cells.clear();
    flips.clear();
  }
};

/// The worth of the worst of some cells.
double worst_of(const CellComplex& complex, const std::vector<std::uint32_t>& cells);
double worst_of(const std::vector<NewCell>& cells);

/// Exactly: are all new cells positive? With the same hull as the old ones they then fill the same space, once.
bool all_positive(const CellComplex& complex, const Change& change);

/// Replaces cells. The new ones may have vertices that the old ones have not, but which have their places in `points`;
/// interior vertices that no new cell has are gone.
///
/// \return the places of the new cells
const std::vector<std::uint32_t>& apply_change(CellComplex& complex, const Change& change);

/// Remembers that something around these vertices is not what it was at the last change.
void note_change(CellComplex& complex, const std::array<std::uint32_t, 4>& vertices);

}  // namespace ccdt
