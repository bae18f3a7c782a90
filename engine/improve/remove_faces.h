#pragma once

#include "engine/improve/change_cells.h"

namespace ccdt {

/// Plans to remove a face, and with it more faces between the two cells' apexes: the cells on both sides of these give
/// way to cells around the edge between the apexes (Shewchuk 2002; the swap 2-3 is the case of one face).
///
/// \param face   of the cell, 0 to 3
/// \param least  the plan must be worth more; no less than the worth of the cell
/// \return       is there such a plan? It is in `change`
bool plan_face_removal(const CellComplex& complex, const QualityGoal& goal, std::uint32_t cell, std::uint32_t face,
                       double least, Change& change);

}  // namespace ccdt
