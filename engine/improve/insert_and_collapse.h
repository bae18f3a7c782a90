#pragma once

#include <vector>

#include "engine/improve/smoothing.h"
#include "engine/tets/cell_set.h"

/// Plans of changes that insert or remove interior vertices, with the terms of engine/tets/swaps.h.
namespace ccdt::improve {

using tets::CellComplex, tets::CellSet, tets::Change, tets::Triangle;

/// Working memory of the plans.
struct PlanScratch {
  CellSet cells;  ///< the star, or all cells that were ever in the cavity
  std::vector<Triangle> hull;
  std::vector<StarFace> faces;  ///< of the hull
  std::vector<tets::NewCell> joined;
  MoveScratch move;
};

/// Plans to remove an interior vertex of a cell by collapsing one of the cell's edges onto the other end: the cells
/// around the vertex that do not contain that end are joined to it instead.
bool plan_collapse(const CellComplex& complex, CellId cell, double least, PlanScratch& scratch, Change& change);

/// Plans to insert a vertex in place of a cell and of neighbors that it can replace by better cells: the cavity grows
/// across each face that would make a bad cell with the new vertex. The vertex then moves to the position where the
/// worst of the new cells is best (after Klingner and Shewchuk 2007). An interior vertex inside the cavity is removed.
/// The new cells are exactly positive.
bool plan_insertion(const CellComplex& x, CellId cell, double least, PlanScratch& cavity, Change& change);

/// Plans to insert a vertex in the center of a cell, whatever the quality: in place of that cell alone, or also of
/// those around it whose spheres contain the vertex. The new cells are exactly positive.
bool plan_split(const CellComplex& x, CellId cell, bool is_alone, PlanScratch& cavity, Change& change);

}  // namespace ccdt::improve
