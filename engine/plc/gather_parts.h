#pragma once

#include <span>

#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The extents of inputs: volumes and measures of quality neither overflow nor vanish.
inline constexpr double least_extent = 1e-100, most_extent = 1e100;

/// Are the points as far apart as these limits allow, or all in one place?
bool has_usual_extent(std::span<const Point3> points);

/// \throw InputError  the vertices have another extent
void check_extent(const InputPlc& input);

/// Fills the grid, the vertices and their data: rounds the vertices of the input to the dyadic grid and merges those
/// that fall on the same point. Ids are given in the order of first appearance.
///
/// \throw InputError  a coordinate that is not finite, with the number of its vertex; or see `check_extent`
void snap_vertices(const InputPlc& input, Plc& plc);

/// Converts a tolerance, adapted to the vertices (`flatness_for`), from a fraction of the bounding box to grid units.
double tolerance_of(const Plc& plc, double flatness);

/// The triangles of the input, without its polygon facets.
TriangleSet gather_triangles(const InputPlc& input, const Plc& plc);

/// The segments that the input lists.
SegmentSet gather_segments(const InputPlc& input, const Plc& plc);

/// Triangulates the polygon facets of the input, exactly, with all their vertices and without their holes, and appends
/// the triangles. A facet without area is left out. Polygons of two vertices, and polygon edges with the facet on both
/// sides, are appended to the segments. Existing segments in a facet, with both ends among its vertices, become edges
/// of its triangles.
///
/// \param tolerance  in grid units: how far from a plane the vertices of a facet may be
/// \throw InputError  a facet is not planar, its edges cross, or a hole seed or vertex is outside
void triangulate_polygons(const InputPlc& input, const Plc& plc, double tolerance, TriangleSet& triangles,
                          SegmentSet& segments);

/// Keeps some triangles, in their order.
///
/// \param is_kept  by triangle
void keep_triangles(std::span<const char> is_kept, TriangleSet& triangles);

/// Drops the triangles that have exactly no area: they bound nothing. CAD programs use them to close the gap where a
/// vertex of one facet is on the edge of another. The vertex stays, and splits that facet
/// (`split_triangles_at_vertices`).
void drop_triangles_without_area(std::span<const Point3> vertices, TriangleSet& triangles);

/// Splits the triangles that contain other vertices (tested exactly), on an edge or inside, so that these become
/// corners. Triangles that conform in space then also conform by their indices.
///
/// \param close  of the triangles
/// \return was anything split? Then the triangles have changed
bool split_triangles_at_vertices(std::span<const Point3> vertices, std::span<const TrianglePair> close,
                                 TriangleSet& triangles);

/// Splits the segments that contain other vertices, drops those without length, and keeps the first of equal ones.
void split_segments_at_vertices(std::span<const Point3> vertices, SegmentSet& segments);

}  // namespace ccdt::plc
