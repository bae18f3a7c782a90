#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/lattice/box.h"
#include "engine/lattice/place_lattice_points.h"

namespace ccdt {

using Corners = std::array<Point3, 3>;

/// The surface that the lattice must stay clear of: views of what the caller has.
struct Surface {
  std::span<const Point3> vertices;
  std::span<const SurfaceTriangle> triangles;
  std::span<const std::array<VertexId, 2>> subsegments;

  Corners corners(std::uint32_t triangle) const {
    const auto& v = triangles[triangle].vertices;
    return {vertices[v[0]], vertices[v[1]], vertices[v[2]]};
  }
};

/// False only if box and triangle are certainly apart (separating axes, with a margin for rounding).
///
/// \param around  the bounding box of the triangle
bool may_touch(const Box& box, const Corners& triangle, const Box& around);

/// A point within the part of the triangle that lies in the box, up to rounding; false if there is no such part.
bool common_point(const Box& box, const Corners& triangle, Point3& point);

/// The squared distance of p and the triangle, which may be degenerate.
double squared_distance(const Corners& triangle, const Point3& p);
double squared_distance(const Point3& a, const Point3& b, const Point3& p);

}  // namespace ccdt
