#pragma once

#include <cstdint>
#include <vector>

#include "engine/tets/cell_complex.h"
#include "engine/tets/shake_cells.h"

namespace ccdt::steiner {

using tets::CellComplex, tets::CellMarks, tets::CellShaker, tets::Change;

/// Changes the cells around a vertex that cannot be removed from a segment, so that the next attempt meets other cells.
/// The changes are random, but the same on every run.
class StarLoosener {
 public:
  explicit StarLoosener(CellComplex& complex);

  /// Removes edges and faces near the vertex at random, whatever the quality. Then removes edges of the vertex as long
  /// as that is possible: a vertex with fewer edges is easier to remove.
  ///
  /// \param shakes  how many edges and faces to try
  void loosen(std::uint32_t vertex, int shakes);

  /// Makes bad cells better by swaps: those around the vertex and those that loosening has made.
  void tidy(std::uint32_t vertex);

 private:
  void shrink(std::uint32_t vertex);
  bool remove_an_edge(std::uint32_t vertex);

  CellComplex& x_;
  CellShaker shaker_;

  std::vector<std::uint32_t> new_cells_;  ///< since the last `tidy`; some may be dead

  // Working memory.
  CellMarks marks_;
  std::vector<std::uint32_t> star_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> made_;
  Change change_;
  Change scratch_;
};

}  // namespace ccdt::steiner
