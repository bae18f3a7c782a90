#pragma once

#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"

namespace ccdt::plc {

/// All pairs of triangles, at most `limit`, that share more than vertices and edges. `sort_around_edges` handles pairs
/// with a common edge. Pairs within a nearly flat facet are left out: its tiny folds are not overlaps.
///
/// \param close  of the triangles
std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, std::span<const TrianglePair> close, std::size_t limit);

/// The same for segments that are not edges of triangles, against triangles and against each other.
///
/// \param loose  the indices of those segments
/// \param tree   over the boxes of the triangles
std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit);

}  // namespace ccdt::plc
