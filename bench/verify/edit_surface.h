#pragma once

#include "bench/verify/regions.h"

namespace ccdt::verify {

/// Adds edges that lie within a facet of another plane, such as the foot of a wall, to that facet, and splits edges at
/// vertices of such lines. Afterwards, facets that touch share edges, and a facet is divided where it borders on
/// different regions.
///
/// If a patch of pieces in one plane has such a line, it is divided into new pieces, without the inner edges of the
/// input. Edges of the input that cross without a common vertex stay unchanged.
void embed_lines(Surface& surface);

/// Changes the surface to that required of a mesh whose boundary vertices were allowed to slide: the pieces of a flat
/// facet become one, and straight chains of edges or of segments become one edge or segment. Curved parts stay
/// unchanged, so no vertex there may move.
///
/// If a flat face continues as a curved one without an edge, the part that is flat up to rounding is one facet.
/// Otherwise, a patch is flat within a quarter of `tolerances.flat`, and a chain is straight within `tolerances.place`.
/// A chain ends where more than two edges and segments meet.
///
/// \param regions  the regions of the surface; afterwards, the same regions for the new pieces
void let_vertices_slide(Surface& surface, Regions& regions);

}  // namespace ccdt::verify
