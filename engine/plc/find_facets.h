#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index_lists.h"
#include "engine/base/point.h"
#include "engine/plc/edge_table.h"

namespace ccdt::plc {

/// Which triangles form one facet.
struct FacetPatches {
  std::vector<std::uint32_t> facet_of;  ///< of each triangle; facets are numbered by their first triangle
  IndexLists members;                   ///< the triangles of each facet
  std::vector<char> exactly_flat;       ///< of each facet: all its vertices are in one plane
  std::vector<char> is_inner_edge;      ///< of each edge: it lies within one facet and is not a segment

  std::uint32_t count() const { return static_cast<std::uint32_t>(exactly_flat.size()); }
};

/// Finds patches of triangles that are flat, exactly or within a tolerance, and orients the triangles of each patch
/// counterclockwise as seen from one side.
///
/// A patch grows from its largest triangle over edges that have exactly two triangles, both with the same marker, and
/// are not input segments. It never folds: every triangle is counterclockwise when projected along the dominant axis of
/// the patch's plane.
///
/// \param vertices    in grid units
/// \param triangles   two corners of a triangle may get exchanged
/// \param edges       follow the triangles' corners, and get their clear `turns`
/// \param segment_of  of each edge: the segment of the input that it is, or `none`
/// \param tolerances  of the triangles, in grid units; their vertices are at most this far from the plane of their
///                    patch
FacetPatches find_facets(std::span<const Point3> vertices, TriangleSet& triangles, EdgeTable& edges,
                         std::span<const std::uint32_t> segment_of, std::span<const double> tolerances);

}  // namespace ccdt::plc
