#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/plc/triangle_set.h"

namespace ccdt::plc {

/// The edges of a set of triangles, sorted by their ends, each with the triangles around it. It does not depend on how
/// the triangles are oriented.
struct EdgeTable {
  std::vector<std::array<VertexId, 2>> ends;  ///< of each edge, the smaller first
  std::vector<std::uint32_t> first;           ///< triangles of edge e: triangles[first[e]] ... triangles[first[e+1]-1]
  std::vector<std::uint32_t> triangles;       ///< increasing within an edge, until `sort_around_edges`
  std::vector<std::array<std::uint32_t, 3>> edges_of;  ///< the three edges of each triangle, in no particular order

  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  std::uint32_t size() const { return static_cast<std::uint32_t>(ends.size()); }
  std::span<const std::uint32_t> around(std::uint32_t edge) const {
    return {triangles.data() + first[edge], first[edge + 1] - first[edge]};
  }
  std::span<std::uint32_t> around(std::uint32_t edge) {
    return {triangles.data() + first[edge], first[edge + 1] - first[edge]};
  }
  /// The edge between two vertices, or `none`.
  std::uint32_t find(VertexId a, VertexId b) const;
};

EdgeTable make_edge_table(std::span<const VertexTriple> triangles);

/// Which edges are segments of the input, and which of these are no edge.
struct SegmentMatch {
  std::vector<std::uint32_t> segment_of;  ///< of each edge: the segment that it is, or `EdgeTable::none`
  std::vector<std::uint32_t> loose;       ///< the segments that are no edge
};

SegmentMatch match_segments(const SegmentSet& segments, const EdgeTable& edges);

/// The angle, exactly classified, by which one must turn about the axis a->b, counterclockwise seen from b, to come
/// from c to d.
enum class Turn { zero, below_180, exactly_180, above_180 };
Turn turn_about(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Sorts the triangles around each edge of three or more by angle, counterclockwise about the axis from its smaller end
/// to its greater.
///
/// \param is_inner_edge  edges within one facet: they have two triangles and are not looked at
/// \param tolerance      in grid units; two facets on the same side of an edge and this near to each other cover each
///                       other
/// \return two triangles that cover each other, if there are any
std::optional<Overlap> sort_around_edges(std::span<const Point3> vertices, const TriangleSet& triangles,
                                         const std::vector<char>& is_inner_edge, double tolerance, EdgeTable& edges);

}  // namespace ccdt::plc
