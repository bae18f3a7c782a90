#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::testing {

/// Pairs of triangles where an edge of one pierces the other, or that share an edge and are folded onto each other. In
/// floating point: touching pairs may or may not be found, but a surface mesh with space between its sheets is judged
/// correctly.
std::vector<std::pair<std::size_t, std::size_t>> crossings(std::span<const Point3> vertices,
                                                           std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace ccdt::testing
