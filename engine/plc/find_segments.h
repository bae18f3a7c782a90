#pragma once

#include <span>
#include <vector>

#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/find_regions.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// All segments: the edges that do not lie within one facet, and the segments of the input that are no edge. Tells
/// which are grazeable: those with a sector of the domain of 180 degrees or more around them.
///
/// \param segment_of  of each edge: the input segment that it is, or `EdgeTable::none`
/// \param loose       the input segments that are no edge
std::vector<Segment> find_segments(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const EdgeTable& edges, const FacetPatches& facets, const SegmentSet& input,
                                   std::span<const std::uint32_t> segment_of, std::span<const std::uint32_t> loose,
                                   const RegionMap& map, const VerticalRays& rays);

}  // namespace ccdt
