#pragma once

#include <span>

#include "engine/base/box_tree.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// Fills the grid, the vertices and all that belongs to them: puts the vertices of the input on the dyadic grid and
/// makes those that fall on the same point one. Ids are given in the order of first appearance.
///
/// \throw InputError  a coordinate that is not finite, with the number of its vertex
void snap_vertices(const InputPlc& input, Plc& plc);

/// A tolerance that is given as a fraction of the box of the vertices, in grid units.
double tolerance_of(const Plc& plc, double flatness);

/// The triangles of the input, without its polygon facets.
TriangleSet gather_triangles(const InputPlc& input, const Plc& plc);

/// The segments that the input lists.
SegmentSet gather_segments(const InputPlc& input, const Plc& plc);

/// Triangulates the polygon facets of the input, exactly, with all their vertices and without their holes, and appends
/// the triangles. A facet without area is left out. Polygons of two vertices, and edges of polygons that have the facet
/// on both sides, are appended to the segments. Segments that are there already and lie in a facet with both ends among
/// its vertices become edges of its triangles.
///
/// \param tolerance  in grid units: how far from a plane the vertices of a facet may be
/// \throw InputError  a facet that is not planar, whose edges cross, or with a hole seed or vertex
///                    outside
void triangulate_polygons(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                          SegmentSet& segments);

/// Drops the triangles that have no area, exactly: they bound nothing. CAD programs close the gap with them where a
/// vertex of one facet is on the edge of another. The vertex stays, and splits that facet
/// (`split_triangles_at_vertices`).
///
/// \return how many
std::uint32_t drop_triangles_without_area(std::span<const Point3> vertices, TriangleSet& triangles);

/// Splits the triangles that other vertices lie on, exactly, in an edge or within, so that those are corners. What was
/// conforming in space is then conforming in its indices as well.
///
/// \param tree  over the boxes of the triangles
/// \return whether anything was split; the triangles are new then
bool split_triangles_at_vertices(std::span<const Point3> vertices, const BoxTree& tree, TriangleSet& triangles);

/// Splits the segments that other vertices lie on, drops those of no length and keeps of equal ones the first.
void split_segments_at_vertices(std::span<const Point3> vertices, SegmentSet& segments);

}  // namespace ccdt::plc
