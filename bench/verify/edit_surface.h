#pragma once

#include "bench/verify/regions.h"

namespace ccdt::verify {

/// Draws edges that lie within a facet of another plane, as the foot of a wall that stands on it, into that facet, and
/// splits edges where vertices of such lines lie on them. Then facets that touch share edges, and a facet is divided
/// where it borders on different regions.
///
/// The patch of pieces in one plane that has such a line becomes new pieces, without the edges that the input has
/// within it. Edges of the input that cross each other without a common vertex are left as they are.
void embed_lines(Surface& surface);

/// Makes the surface what a mesh must have whose boundary vertices were allowed to slide: the pieces of a flat facet
/// become one, and straight chains of edges or of segments become one edge or segment. What is curved stays as it is,
/// so that no vertex there may move.
///
/// A flat face that goes over into a curved one without an edge is one facet as far as it is flat but for rounding.
/// Else, a patch is flat within a quarter of `tolerances.flat`, a chain straight within `tolerances.place`. A chain
/// ends where more than two edges and segments meet.
///
/// \param regions  of the surface; as before, for the new pieces
void let_vertices_slide(Surface& surface, Regions& regions);

}  // namespace ccdt::verify
