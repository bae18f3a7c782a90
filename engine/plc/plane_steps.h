#pragma once

#include <optional>

#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The shortest vector of integer coordinates in the direction from one point of integer coordinates to another.
Point3 shortest_step(const Point3& from, const Point3& to);

/// A point of a plane plus integer multiples of these steps, which have integer coordinates, is exactly in the plane.
/// The steps are short and nearly orthogonal.
struct PlaneSteps {
  Point3 base;
  Point3 u, v;
};

/// \param a, b, c  points of integer coordinates, not on one line
PlaneSteps steps_in_plane(const Point3& a, const Point3& b, const Point3& c);

/// The steps in the plane of an exactly flat facet, computed from corners of the input, which are multiples of the
/// quantum. From other vertices, they would be as long as the triangles.
std::optional<PlaneSteps> steps_of_facet(std::span<const std::array<VertexId, 3>> triangles,
                                         const std::vector<Point3>& points);

}  // namespace ccdt::plc
