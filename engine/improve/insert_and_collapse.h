#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/improve/smoothing.h"

/// Plans of changes that insert or remove interior vertices, with the terms of engine/tets/swaps.h.
namespace ccdt::improve {

using tets::Cell, tets::Change, tets::NewCell, tets::cell_of, tets::corners_of_face, tets::face_code;

/// The cells that a new vertex replaces, and their hull.
struct VertexCavity {
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> tried;                ///< all cells that were ever in it
  std::vector<std::array<std::uint32_t, 3>> hull;  ///< corners of its faces, the inside above
  std::vector<StarFace> faces;                     ///< the same, by their points
};

/// Working memory of the plans.
struct PlanScratch {
  CellMarks marks;
  std::vector<std::uint32_t> star;
  std::vector<NewCell> joined;
  VertexCavity cavity;
  MoveScratch move;
};

/// Plans to remove an interior vertex of a cell by collapsing one of the cell's edges onto the other end: the cells
/// around the vertex without that end are joined to it instead.
bool plan_collapse(const CellComplex& complex, std::uint32_t cell, double least, PlanScratch& scratch, Change& change);

/// Plans to insert a vertex in place of a cell and of those of its neighbors that the new vertex can replace by better
/// ones: the cavity grows across each face that would make a bad cell with the new vertex. The vertex then moves to the
/// position where the worst of the new cells is best (after Klingner and Shewchuk 2007). An interior vertex inside the
/// cavity is removed.
bool plan_insertion(const CellComplex& complex, std::uint32_t cell, double least, PlanScratch& scratch, Change& change);

}  // namespace ccdt::improve
