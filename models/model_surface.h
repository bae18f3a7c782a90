#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/input.h"

namespace ccdt::models {

/// A triangulated surface while it is assembled from patches.
///
/// Patches that meet share the vertices of their common curve by index, because each curve is cut into edges once.
struct ModelSurface {
  std::vector<Point3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<int> markers;                                ///< one per triangle
  std::map<std::array<double, 3>, std::uint32_t> corners;  ///< where curves end
};

/// Vertices along a curve, in order. An open chain holds both ends; a closed one does not repeat its first vertex.
using Chain = std::vector<std::uint32_t>;

/// Adds a vertex without checking whether it exists already.
std::uint32_t add_vertex(ModelSurface& surface, const Point3& point);

/// The corner at exactly these coordinates; added when it is new.
std::uint32_t corner(ModelSurface& surface, const Point3& point);

void add_triangle(ModelSurface& surface, std::uint32_t a, std::uint32_t b, std::uint32_t c, int marker);

double distance(const Point3& a, const Point3& b);

Chain reversed(const Chain& chain);

/// Joins open chains to one closed chain. Each must start where the one before ends, and the first where the last ends.
/// \throw std::logic_error  they do not
Chain closed_loop(std::span<const Chain> chains);

/// Moves the surface into an input with triangles and markers only.
plc::InputPlc to_input(ModelSurface&& surface, plc::InputPlc::Inside inside);

}  // namespace ccdt::models
