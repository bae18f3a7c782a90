#pragma once

#include <array>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The corners of a triangle.
using VertexTriple = std::array<VertexId, 3>;

/// All facets of the input as triangles; all arrays are indexed by triangle.
struct TriangleSet {
  std::vector<VertexTriple> corners;
  std::vector<int> markers;
  std::vector<std::uint32_t> numbers;  ///< number in the file of the triangle's facet
  std::vector<std::uint32_t> faces;  ///< what the triangles are in a simplicial complex that has all vertices, such as
                                     ///< their Delaunay tetrahedralization; of two with the same corners, at most one
                                     ///< is known. `no_face`: not in it, or not known

  std::uint32_t size() const { return static_cast<std::uint32_t>(corners.size()); }
  void reserve(std::size_t count) {
    corners.reserve(count), markers.reserve(count), numbers.reserve(count), faces.reserve(count);
  }
  void add(const VertexTriple& c, int marker, std::uint32_t number, std::uint32_t face = no_face) {
    corners.push_back(c);
    markers.push_back(marker);
    numbers.push_back(number);
    faces.push_back(face);
  }
};

/// The segments that the input itself lists; all arrays are indexed by segment.
struct SegmentSet {
  std::vector<std::array<VertexId, 2>> ends;
  std::vector<int> markers;

  std::uint32_t size() const { return static_cast<std::uint32_t>(ends.size()); }
  void add(VertexId a, VertexId b, int marker) {
    ends.push_back({a, b});
    markers.push_back(marker);
  }
};

inline std::array<Point3, 3> points_of(std::span<const Point3> vertices, const VertexTriple& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

/// The corner of a triangle after another one.
constexpr std::size_t next_corner(std::size_t corner) {
  return corner == 2 ? 0 : corner + 1;
}

inline bool has_corner(const VertexTriple& t, VertexId v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

/// Does the triangle run through its edge ab from a to b (and not from b to a)?
inline bool runs_along(const VertexTriple& t, VertexId a, VertexId b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

/// The corner that is not on the edge ab.
inline VertexId apex_over(const VertexTriple& t, VertexId a, VertexId b) {
  return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
}

/// A side of a triangle: the one that its normal points to, or the other.
constexpr std::uint32_t side_of(std::uint32_t triangle, bool above) {
  return 2 * triangle + (above ? 0 : 1);
}
constexpr bool is_above(std::uint32_t side) {
  return side % 2 == 0;
}
constexpr std::uint32_t triangle_of(std::uint32_t side) {
  return side / 2;
}
constexpr std::uint32_t opposite_of(std::uint32_t side) {
  return side ^ 1;
}

/// An angle, exactly classified.
enum class Turn : std::uint8_t { unknown, zero, below_180, exactly_180, above_180 };

/// Two triangles or segments that share more than vertices and edges, and a shared point in grid units.
struct Overlap {
  enum class Between { facets, covering_facets, facet_and_segment, segments };
  Between between;
  std::uint32_t first, second;  ///< triangles or segments, depending on `between`
  Point3 where;
};

/// The edges of a set of triangles, sorted by their ends, each with the triangles around it.
///
/// For each of its triangles, an edge knows the side that the next sector is on, counterclockwise about the edge from
/// its smaller end to its greater one. It is the upper side if the triangle runs along the edge in that direction.
struct EdgeTable {
  std::vector<std::array<VertexId, 2>> ends;           ///< of each edge, the smaller first
  std::vector<std::uint32_t> first;                    ///< the sides of edge e: sides[first[e]] ... sides[first[e+1]-1]
  std::vector<std::uint32_t> sides;                    ///< increasing within an edge, until `sort_around_edges`
  std::vector<std::array<std::uint32_t, 3>> edges_of;  ///< the three edges of each triangle, in no particular order
  std::vector<Turn> turns;  ///< at an edge of two triangles: the angle from the first to the second, counterclockwise
                            ///< as above; clear ones by `find_facets`, the others, except within one facet, by
                            ///< `sort_around_edges`

  std::uint32_t size() const { return static_cast<std::uint32_t>(ends.size()); }
  std::span<const std::uint32_t> sides_around(std::uint32_t edge) const {
    return {sides.data() + first[edge], first[edge + 1] - first[edge]};
  }
  std::span<std::uint32_t> sides_around(std::uint32_t edge) {
    return {sides.data() + first[edge], first[edge + 1] - first[edge]};
  }
  /// The triangles at an edge.
  auto around(std::uint32_t edge) const { return sides_around(edge) | std::views::transform(triangle_of); }
  /// The edge between two vertices, or `none`.
  std::uint32_t find(VertexId a, VertexId b) const;
};

EdgeTable make_edge_table(std::span<const VertexTriple> triangles);

/// Which edges are segments of the input, and which segments are not edges.
struct SegmentMatch {
  std::vector<std::uint32_t> segment_of;  ///< of each edge: the segment that it is, or `none`
  std::vector<std::uint32_t> loose;       ///< the segments that are not edges
};

SegmentMatch match_segments(const SegmentSet& segments, const EdgeTable& edges);

/// Corrects the table after two corners of the triangle were exchanged.
void note_turned(std::uint32_t triangle, EdgeTable& edges);

/// The angle of the turn about the axis a->b, counterclockwise seen from b, that takes c to d.
Turn turn_about(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Sorts the triangles around each edge of three or more by angle, counterclockwise about the axis from its smaller end
/// to its greater one, and finds the angles at edges of two that `find_facets` has not found.
///
/// \param is_inner_edge  edges within one facet: they have two triangles and are skipped
/// \param tolerance      in grid units; two facets on the same side of an edge cover each other if they are this near.
///                       At most the tolerances that `find_facets` had
/// \return pairs of triangles that cover each other, at most `limit`; if it is reached, not all edges are sorted
std::vector<Overlap> sort_around_edges(std::span<const Point3> vertices, const TriangleSet& triangles,
                                       const std::vector<char>& is_inner_edge, double tolerance, EdgeTable& edges,
                                       std::size_t limit);

}  // namespace ccdt::plc
