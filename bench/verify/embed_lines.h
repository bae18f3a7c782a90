#pragma once

#include "bench/verify/surface.h"

namespace ccdt::verification {

/// Draws edges that lie within a facet of another plane, as the foot of a wall that stands on it, into that facet, and
/// splits edges where vertices of such lines lie on them. Then facets that touch share edges, and a facet is divided
/// where it borders on different regions.
///
/// The patch of pieces in one plane that has such a line becomes new pieces, without the edges that the input has
/// within it. Edges of the input that cross each other without a common vertex are left as they are.
void embed_lines(Surface& surface);

}  // namespace ccdt::verification
