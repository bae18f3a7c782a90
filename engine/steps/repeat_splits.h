#pragma once

#include "engine/folds/protect_facets.h"
#include "engine/protection/segment_chains.h"
#include "engine/steps/run.h"

namespace ccdt::steps {

/// Gives segments on opposite sides of a periodic PLC the vertices that protection gave any of them.
///
/// \param chains     after protection
/// \param protector  starts again with all of these vertices
/// \return           false if they have the same vertices already
bool repeat_splits(const protection::SegmentChains& chains, folds::SurfaceProtector& protector, Run& run);

}  // namespace ccdt::steps
