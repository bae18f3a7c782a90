#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/improve/counts.h"
#include "engine/improve/insert_and_collapse.h"
#include "engine/improve/options.h"
#include "engine/improve/plan_reconnection.h"
#include "engine/tets/swaps.h"

namespace ccdt::improve {

using tets::Cavity;

/// The effort for a cell.
enum class Effort { usual, greatest };

/// A vertex and the place that it moves to.
struct Move {
  std::uint32_t vertex = 0;
  Point3 place;
  std::vector<std::uint32_t> star;     ///< the cells around it
  std::vector<std::uint32_t> corners;  ///< of these, some repeatedly
};

/// What improves a bad cell next.
struct Step {
  enum class Kind { none, change, moves };

  Kind kind = Kind::none;

  // A change.
  Change change;                                  ///< all new cells are positive
  Cavity cavity;                                  ///< of the change
  std::uint64_t ImproveCounts::*count = nullptr;  ///< where it counts

  // Moves of vertices of the cell, one after the other.
  std::array<Move, 4> moves;
  std::size_t move_count = 0;

  /// The vertices of all cells that could have been replaced by a new vertex or a reconnection.
  std::vector<std::uint32_t> far_vertices;
  Box space_taken = empty_box;  ///< around that of all plans that were made (`Change::space_taken`)
};

/// The corners of a cell and the apexes of its neighbors; a corner again where a neighbor is missing. All that
/// `StepFinder::find` looks at is in cells with one of these vertices or with one of `Step::far_vertices`. So a change
/// that touches such a cell is a change around one of them.
std::array<std::uint32_t, 8> vertices_near(const CellComplex& complex, std::uint32_t cell);

/// Finds steps. It does not change the complex, so several finders may work at the same time.
class StepFinder {
 public:
  /// \param freedom  of the vertices that are not interior; empty: they stay
  StepFinder(const CellComplex& complex, const std::vector<Freedom>& freedom, Improvement improvement)
      : x_(complex), freedom_(freedom), improvement_(improvement), reconnection_(complex) {}

  /// The best of all swaps that involve a cell; if there is none, its vertices that can move to better places, until
  /// it is good enough; with the greatest effort, else a polyhedron to reconnect, or a vertex to remove or to insert.
  ///
  /// \param has_moved  try only the last
  void find(std::uint32_t cell, bool has_moved, Effort effort, Step& step);

 private:
  void find_any(std::uint32_t cell, bool has_moved, Effort effort, Step& step);
  bool find_swap(std::uint32_t cell, Step& step);
  bool find_moves(std::uint32_t cell, Effort effort, Step& step);
  bool find_collapse(std::uint32_t cell, Step& step);
  bool find_insertion(std::uint32_t cell, Step& step);
  bool find_reconnection(std::uint32_t cell, Step& step);
  bool can_move(std::uint32_t vertex, Effort effort, Step& step);
  double gather_moved_star(std::uint32_t vertex, const Step& step);
  Point3 point_after(const Step& step, std::uint32_t vertex) const;
  double quality_after(const Step& step, const std::array<std::uint32_t, 4>& vertices) const;

  const CellComplex& x_;
  const std::vector<Freedom>& freedom_;
  const Improvement improvement_;

  // Working memory.
  Change plan_;
  PlanScratch scratch_;
  VertexStar star_;
  Reconnection reconnection_;
};

}  // namespace ccdt::improve
