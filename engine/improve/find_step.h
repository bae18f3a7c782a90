#pragma once

#include <cstdint>
#include <vector>

#include "engine/improve/counts.h"
#include "engine/improve/topological_changes.h"

namespace ccdt::improve {

/// The effort for a cell.
enum class Effort { usual, greatest };

/// What improves a bad cell next.
struct Step {
  enum class Kind { none, swap, move };

  Kind kind = Kind::none;

  // A swap.
  Change change;                                  ///< all new cells are positive
  std::uint64_t ImproveCounts::*count = nullptr;  ///< where it counts

  // A move.
  std::uint32_t corner = 0;         ///< of the cell: the vertex that moves
  Point3 place;                     ///< where it moves to
  std::vector<std::uint32_t> star;  ///< the cells around it
};

/// Finds steps. It does not change the complex, so several finders may work at the same time.
class StepFinder {
 public:
  /// \param freedom  of the vertices that are not interior; empty: they stay
  StepFinder(const CellComplex& complex, const std::vector<Freedom>& freedom, Improvement improvement)
      : x_(complex), freedom_(freedom), improvement_(improvement) {}

  /// The best of all swaps that involve a cell; if there is none, the first of its vertices that can move to a better
  /// place.
  void find(std::uint32_t cell, Effort effort, Step& step);

  /// The first move among the vertices of a cell from this corner on.
  void find_move(std::uint32_t cell, std::uint32_t first_corner, Effort effort, Step& step);

  /// Does `find` give the same as after this many changes of the complex? The cell itself must be the same.
  ///
  /// Each cell and each point that `find` looks at is in a cell with a corner of the given cell, or with the apex of
  /// one of its neighbors. A change that touches such a cell changes the surroundings of that vertex.
  bool is_unchanged_since(std::uint64_t change_count, std::uint32_t cell) const;

 private:
  bool find_swap(std::uint32_t cell, Step& step);
  bool can_move(std::uint32_t vertex, Effort effort, Step& step);

  const CellComplex& x_;
  const std::vector<Freedom>& freedom_;
  const Improvement improvement_;

  // Working memory.
  Change plan_;
  CellMarks marks_;
  VertexStar star_;
  MoveScratch move_;
};

}  // namespace ccdt::improve
