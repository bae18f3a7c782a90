#pragma once

#include "engine/improve/change_cells.h"

namespace ccdt {

/// Plans to take an interior vertex of a cell away by collapsing one of the cell's edges onto the other end: the cells
/// around the vertex that do not have that end are joined to it instead.
///
/// \param least  the plan must be worth more; no less than the worth of the cell
/// \return       is there such a plan? The best one is in `change`
bool plan_collapse(CellComplex& complex, const QualityGoal& goal, std::uint32_t cell, double least, Change& change);

}  // namespace ccdt
