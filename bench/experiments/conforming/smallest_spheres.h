#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"

namespace ccdt::conforming {

/// Where is p with respect to the smallest sphere through the corners of a triangle, whose center is in its plane? +1:
/// strictly inside, 0: on it, -1: outside. Exact: a floating-point filter, then wide integers. Shares no predicate with
/// the engine.
///
/// \pre coordinates are integers of at most 2^52 in magnitude, as in grid units; the corners are not on one line
int side_of_smallest_sphere(const std::array<Point3, 3>& triangle, const Point3& p);

/// What the smallest sphere of a triangle holds besides its corners.
enum class SphereContent : std::uint8_t {
  nothing,   ///< no vertex inside or on it
  touching,  ///< vertices on it, none strictly inside; usual in regular grids
  vertices   ///< a vertex strictly inside
};

/// The contents of the smallest spheres of triangles: the condition of Radovitzky and Ortiz (2000), as the paper states
/// it in section 5.2, is that no sphere of a boundary triangle holds a vertex.
///
/// \param points  of all vertices, in grid units
std::vector<SphereContent> contents_of_smallest_spheres(std::span<const std::array<VertexId, 3>> triangles,
                                                        std::span<const Point3> points);

}  // namespace ccdt::conforming
