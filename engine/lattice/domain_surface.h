#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/base/index.h"
#include "engine/base/point.h"

namespace ccdt::lattice {

/// A triangle of a facet, counterclockwise as seen from above, and its two sides.
struct SurfaceTriangle {
  std::array<VertexId, 3> vertices;
  bool inside_above = false, inside_below = false;  ///< does the domain lie there?
};

/// The corners of a triangle.
using TrianglePoints = std::array<Point3, 3>;

/// The surface that the lattice must keep away from: views of the caller's data.
struct DomainSurface {
  std::span<const Point3> vertices;
  std::span<const SurfaceTriangle> triangles;
  std::span<const std::array<VertexId, 2>> subsegments;

  TrianglePoints corners(const std::array<VertexId, 3>& v) const {
    return {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
  }
  TrianglePoints corners(std::uint32_t triangle) const { return corners(triangles[triangle].vertices); }
};

}  // namespace ccdt::lattice
