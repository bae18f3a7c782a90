#pragma once

#include "engine/improve/change_cells.h"

namespace ccdt {

/// Plans to insert a vertex in place of a cell and of those of its neighbors that the new vertex can replace by better
/// ones: the cavity grows across each face that would make a bad cell with the new vertex, which then moves to where
/// the worst of the new cells is best (after Klingner and Shewchuk 2007). A vertex of ours that ends up inside the
/// cavity is gone. The new vertex is the last one of the complex.
///
/// \param least  the plan must be worth more; no less than the worth of the cell
/// \return       is there such a plan? It is in `change`
bool plan_insertion(CellComplex& complex, const QualityGoal& goal, std::uint32_t cell, double least, Change& change);

}  // namespace ccdt
