#pragma once

#include "bench/verify/regions.h"

namespace ccdt::verify {

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
