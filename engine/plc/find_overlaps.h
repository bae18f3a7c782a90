#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/geometry/box_tree.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/find_facets.h"

namespace ccdt::plc {

/// All pairs of triangles, at most `limit`, that meet in more than common vertices and edges. `sort_around_edges`
/// handles pairs with a common edge. Pairs within a facet that is flat only within the tolerance are left out: its tiny
/// folds are not overlaps.
///
/// \param close  of the triangles
std::vector<Overlap> find_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                   const FacetPatches& facets, std::span<const TrianglePair> close, std::size_t limit);

/// The same for segments that are not edges of triangles, with triangles and with each other.
///
/// \param loose  the indices of those segments
/// \param tree   over the boxes of the triangles
std::vector<Overlap> find_segment_overlaps(std::span<const Point3> vertices, const TriangleSet& triangles,
                                           const SegmentSet& segments, std::span<const std::uint32_t> loose,
                                           const BoxTree& tree, std::size_t limit);

// ---- Exact tests of pairs --------------------------------------------------------------------------------------

/// A point where two elements meet but should not; the decision is exact, the point is rounded.
struct Contact {
  Point3 where;
  bool coplanar = false;
};

/// Where a segment meets a triangle, both closed; nothing if they are apart.
std::optional<Contact> meet_segment_triangle(const Point3& p, const Point3& q, const std::array<Point3, 3>& triangle);

/// Where two triangles without a common vertex meet, both closed. Their corners can be any points of the grid.
std::optional<Contact> meet_triangles(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t);

/// Where two triangles with only the common corner s[0] = t[0] meet elsewhere. Again, any points of the grid.
std::optional<Contact> meet_triangles_at_corner(const std::array<Point3, 3>& s, const std::array<Point3, 3>& t);

/// Where a segment from a corner of a triangle, t[0], meets the triangle elsewhere.
std::optional<Contact> meet_segment_at_corner(const Point3& end, const std::array<Point3, 3>& t);

/// Where two segments meet, both closed; they need not be in one plane.
std::optional<Contact> meet_segments(const Point3& p, const Point3& q, const Point3& a, const Point3& b);

/// Is the point within the closed triangle, in space?
///
/// \param axis  an axis that the triangle's plane is not parallel to
bool is_on_triangle(int axis, const Point3& p, const std::array<Point3, 3>& triangle);

/// Is the point between the ends of the segment, in space, ends excluded?
bool is_within_segment(const Point3& p, const Point3& a, const Point3& b);

}  // namespace ccdt::plc
