#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/repair/find_cuts.h"

namespace ccdt::repair {

/// The cuts of one triangle, divided where they meet each other and its edges. All points are rounded to the grid.
struct Arrangement {
  std::uint32_t triangle = 0;
  std::vector<std::array<Point3, 2>> pieces;             ///< not on an edge; their ends may be equal
  std::vector<std::pair<std::size_t, Point3>> on_edges;  ///< points on the edge from this corner to the next
};

/// Arrangements of all triangles that are cut, by triangle. What two triangles have in common is divided at the same
/// exact points in both, so these are rounded alike.
std::vector<Arrangement> arrange_cuts(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
                                      std::span<const Cut> cuts);

}  // namespace ccdt::repair
