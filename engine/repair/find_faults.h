#pragma once

#include "engine/base/flatness.h"
#include "engine/base/progress.h"
#include "engine/plc/input.h"
#include "engine/repair/faults.h"

namespace ccdt::repair {

/// Lists everything that is wrong with an input, instead of stopping at the first error as `plc::build_plc` does.
///
/// The input is valid exactly if `plc::build_plc` accepts it after `plc::triangulate_warped_facets`. If a coordinate is
/// not finite, or no facet has an area, nothing else is looked for.
///
/// \param input     as it was read
/// \param flatness  tolerance for flat facets, as in the mesher
/// \param progress  called repeatedly; throw from it to cancel
/// \throw InputError  an index is out of range, or a list incomplete, as in no file; the tolerance is negative or not a
///                    number
Diagnosis find_faults(const plc::InputPlc& input, double flatness = usual_flatness, const Progress& progress = {});

}  // namespace ccdt::repair
