#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/improve/counts.h"
#include "engine/improve/insert_and_collapse.h"
#include "engine/improve/options.h"
#include "engine/improve/plan_reconnection.h"

namespace ccdt::improve {

/// The effort for a cell.
enum class Effort { usual, greatest };

/// What steps may do.
struct StepRules {
  Improvement improvement = Improvement::all;
  const std::vector<Freedom>& freedom;  ///< of the vertices that are not interior; empty: they stay
};

/// A vertex and the place that it moves to.
struct Move {
  std::uint32_t vertex = 0;
  Point3 place;
  std::vector<CellId> star;  ///< the cells around it
};

/// What improves a bad cell next.
struct Step {
  enum class Kind { none, change, moves };

  Kind kind = Kind::none;

  // A change.
  Change change;                                  ///< all new cells are positive
  tets::Cavity cavity;                            ///< of the change
  std::uint64_t ImproveCounts::*count = nullptr;  ///< where it counts

  // Moves of vertices of the cell, one after another.
  std::array<Move, 4> moves;
  std::size_t move_count = 0;

  /// The vertices of all cells that could have been replaced by a new vertex or a reconnection.
  std::vector<std::uint32_t> far_vertices;
  Box space_taken = empty_box;  ///< encloses the space of all plans (`Change::space_taken`)
};

/// Working memory of `find_step`.
struct StepScratch {
  Change swap;
  PlanScratch plan;
  ReconnectionScratch reconnection;
};

/// The corners of a cell and the apexes of its neighbors; a corner again where a neighbor is missing. Everything that
/// `find_step` looks at is in cells with one of these vertices or one of `Step::far_vertices`. So a change that touches
/// such a cell is a change around one of these vertices.
std::array<std::uint32_t, 8> vertices_near(const CellComplex& complex, CellId cell);

/// Finds the best of all swaps that involve a cell. If there is none, finds moves of the cell's vertices to better
/// places, until the cell is good enough. If that fails, and with the greatest effort, finds a polyhedron to reconnect,
/// or a vertex to remove or insert.
///
/// \param has_moved  if true, only these last steps are tried
void find_step(const CellComplex& complex, const StepRules& rules, CellId cell, bool has_moved, Effort effort,
               StepScratch& scratch, Step& step);

}  // namespace ccdt::improve
