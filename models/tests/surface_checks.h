#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/plc/input.h"

namespace ccdt::testing {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Markers of the bracket's facets that are not boundary (see models/parts.h).
inline constexpr int interior_face_marker = 8;
inline constexpr int slit_marker = 9;

/// The triangles that bound the body: all but the bracket's interior ones.
Triangles boundary_triangles(const plc::InputPlc& input);
Triangles triangles_with_marker(const plc::InputPlc& input, int marker);

/// How often an edge is used from its smaller to its greater vertex, and in the opposite direction.
struct EdgeUse {
  std::array<std::uint32_t, 2> ends;
  int forwards = 0, backwards = 0;
};
/// Sorted by the ends.
std::vector<EdgeUse> edges_of(const Triangles& triangles);

double enclosed_volume(const std::vector<Point3>& vertices, const Triangles& triangles);

/// How often the surface winds around a point: 1 inside, 0 outside.
double winding_number(const std::vector<Point3>& vertices, const Triangles& triangles, const Point3& point);

/// Vertices - edges + triangles, with the vertices that the triangles use.
long euler_characteristic(const Triangles& triangles);

/// The value below which this fraction of the values lies.
double quantile(std::vector<double> values, double fraction);

std::vector<double> smallest_angles(const plc::InputPlc& input);  ///< one per triangle, in degrees
std::vector<double> edge_lengths(const plc::InputPlc& input);     ///< each edge once

}  // namespace ccdt::testing
