#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"

namespace ccdt::plc {

/// The corners of a triangle.
using VertexTriple = std::array<VertexId, 3>;

/// All facets of the input as triangles; arrays indexed alike by the triangle.
struct TriangleSet {
  std::vector<VertexTriple> corners;
  std::vector<int> markers;
  std::vector<std::uint32_t> numbers;  ///< number in the file of the facet that the triangle is (a part of)

  std::uint32_t size() const { return static_cast<std::uint32_t>(corners.size()); }
  void add(const VertexTriple& c, int marker, std::uint32_t number) {
    corners.push_back(c);
    markers.push_back(marker);
    numbers.push_back(number);
  }
};

/// The segments that the input itself names; arrays indexed alike.
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

/// Two things that meet in more than common vertices and edges, and a point of that in grid units.
struct Overlap {
  enum class Between { facets, covering_facets, facet_and_segment, segments };
  Between between;
  std::uint32_t first, second;  ///< triangles or segments, as `between` says
  Point3 where;
};

}  // namespace ccdt::plc
