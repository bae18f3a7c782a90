#pragma once

#include <span>

#include "engine/base/box_tree.h"
#include "engine/base/point.h"
#include "engine/plc/triangle_set.h"

namespace ccdt {

/// Splits the triangles that other vertices lie on, exactly, in an edge or within, so that those are corners. What was
/// conforming in space is then conforming in its indices as well.
///
/// \param tree  over the boxes of the triangles
/// \return      whether anything was split; the triangles are new then
bool split_triangles_at_vertices(std::span<const Point3> vertices, const BoxTree& tree, TriangleSet& triangles);

/// Splits the segments that other vertices lie on, drops those of no length and keeps of equal ones the first.
void split_segments_at_vertices(std::span<const Point3> vertices, SegmentSet& segments);

}  // namespace ccdt
