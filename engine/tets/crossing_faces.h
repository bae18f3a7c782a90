#pragma once

#include "engine/tets/cell_complex.h"

namespace ccdt::tets {

/// Exactly: would new faces on the boundary of the domain take space outside that is not free?
///
/// In a facet that is flat only within the tolerance, new faces are not quite where the old ones were. Positive cells
/// with the same hull fill the same space inside. But where the new faces are farther out, another part of the domain
/// may be in the way. Then faces of it meet the new ones in more than common corners and edges, or lie between the new
/// and the old ones: there they have a corner, or all of their corners are those of the old faces.
bool would_cross(const CellComplex& complex, const Change& change);

}  // namespace ccdt::tets
