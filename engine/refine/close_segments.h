#pragma once

#include <array>
#include <limits>
#include <vector>

#include "engine/plc/plc.h"

namespace ccdt::refine {

/// How near to each end of a segment it may get vertices, as distances from that end.
///
/// A vertex on a segment is in the diametral spheres of the pieces of a segment close beside it, unless that has a
/// vertex at the same height. But vertices are on the grid: a segment has 2^20 places for them. Where segments are too
/// close for that, each new vertex would need another one on the other segment, again and again.
using LeastDistances = std::array<double, 2>;

/// Segments that meet at this end have no small angle.
inline constexpr double no_small_angle = 0;
/// The segment runs beside another one so closely that it may get no vertices at all.
inline constexpr double no_vertices = std::numeric_limits<double>::infinity();

/// \return  by segment of the PLC, in grid units
std::vector<LeastDistances> find_close_segments(const plc::Plc& plc);

}  // namespace ccdt::refine
