#pragma once

#include <vector>

#include "engine/base/progress.h"
#include "engine/improve/cell_complex.h"
#include "engine/improve/counts.h"
#include "engine/improve/move_apex.h"
#include "engine/improve/options.h"

namespace ccdt {

/// Improves the cells that are not good enough, the worst first: by swaps, by moving vertices, and where both are stuck
/// by inserting and removing interior vertices. What a change makes is always worth more than what it replaces, the
/// worst against the worst, and exactly positive. Cells whose surroundings have changed are tried again, until all are
/// good enough, nothing helps any more, or the time is up.
///
/// \param freedom  of the vertices below `first_interior`; empty: they stay
ImproveCounts improve_cells(CellComplex& complex, const std::vector<Freedom>& freedom, const ImproveOptions& options,
                            const Progress& progress = {});

}  // namespace ccdt
