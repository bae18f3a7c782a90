#pragma once

#include <span>

#include "engine/delaunay/delaunay.h"
#include "engine/plc/facet_part.h"
#include "engine/plc/plc.h"

namespace ccdt::retry {

/// Are two faces of the same facet, and do they overlap by more than rounding?
bool overlap(const plc::FacetPart& one, const plc::FacetPart& other);

/// Divides facets that are flat only within the tolerance: the Delaunay triangles of such a facet that overlap one of
/// the parts become facets of their own, with segments between them. These triangles are better than those of the
/// input, among which there may be needles that nothing can protect. A Delaunay triangle that is itself a needle stays
/// with the triangle at its longest edge.
///
/// \param delaunay   of the vertices
/// \param tolerance  of the facets, in grid units
void divide_facets(const delaunay::Delaunay& delaunay, std::span<const plc::FacetPart> parts, double tolerance,
                   plc::Plc& plc);

}  // namespace ccdt::retry
