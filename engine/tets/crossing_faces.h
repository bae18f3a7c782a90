#pragma once

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// Would new faces on the boundary of the domain take space outside that is not free? Exact.
///
/// In a nearly flat facet, new faces are not quite where the old ones were. Positive cells with the same hull fill the
/// same space inside. But where the new faces are farther out, another part of the domain may be in the way. Then its
/// faces share more than corners and edges with the new ones, or lie between the new and the old ones. In the latter
/// case they have a corner there, or all of their corners are corners of the old faces.
bool would_cross(const CellComplex& complex, const Change& change);

}  // namespace ccdt::tets
