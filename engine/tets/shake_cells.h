#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// Makes random changes, the same on every run, where no change that is looked for helps: after them, others are
/// possible.
class CellShaker {
 public:
  explicit CellShaker(CellComplex& complex) : x_(complex) {}

  /// Removes edges and faces of cells near a vertex, at random.
  ///
  /// \param tries  how many edges and faces to try
  /// \param least  all new cells are better than this
  /// \param made   gets the new cells; later ones may have replaced some of them
  void shake(std::uint32_t vertex, int tries, double least, std::vector<std::uint32_t>& made);

 private:
  std::uint32_t random_cell_near(std::uint32_t vertex);

  CellComplex& x_;
  std::mt19937 random_{2};

  // Working memory.
  Change change_;
  std::vector<std::uint32_t> new_cells_;
};

}  // namespace ccdt::tets
