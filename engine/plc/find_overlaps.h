#pragma once

#include <span>
#include <vector>

#include "engine/base/box_tree.h"
#include "engine/base/point.h"
#include "engine/plc/find_facets.h"
#include "engine/plc/refusals.h"
#include "engine/plc/triangle_set.h"

namespace ccdt {

/// The boxes of triangles.
std::vector<Box> boxes_of(std::span<const Point3> vertices, const TriangleSet& triangles);

/// All pairs of triangles, at most `limit`, that meet in more than common vertices and edges. Pairs with a common edge
/// are the business of `sort_around_edges`, and those of a facet that is flat only within the tolerance are left out:
/// its tiny folds are no overlap.
///
/// \param tree  over `boxes_of(vertices, triangles)`
std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, const BoxTree& tree, std::size_t limit);

/// The same for segments that are no edges of triangles, with triangles and with each other.
///
/// \param loose  the indices of those segments
std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit);

}  // namespace ccdt
