#pragma once

#include <span>

#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/plc/triangle_set.h"

namespace ccdt::plc {

/// Triangulates the polygon facets of the input, exactly, with all their vertices and without their holes, and appends
/// the triangles. Polygons of two vertices, and edges of polygons that have the facet on both sides, are appended to
/// the segments. Segments that are there already and lie in a facet with both ends among its vertices become edges of
/// its triangles.
///
/// \param tolerance  in grid units: how far from a plane the vertices of a facet may be
/// \throw InputError  a facet that is not planar, that has no area, whose edges cross, or with a hole seed or vertex
///                    outside
void triangulate_polygons(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                          SegmentSet& segments);

}  // namespace ccdt::plc
