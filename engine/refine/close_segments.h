#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "engine/plc/plc.h"

namespace ccdt::refine {

/// How near to each of its ends a segment may get vertices, as distances from these ends; short pieces may end nearer
/// (`may_end_at`).
///
/// A vertex on a segment is inside a diametral sphere of a segment close beside it, unless the latter has a vertex at
/// the same height. But vertices must be on the grid, where a segment has 2^20 places for them. Where two segments are
/// too close for these places to fit, each new vertex on one would need another on the other, without end.
using LeastDistances = std::array<double, 2>;

/// No segments meet at a small angle at this end.
inline constexpr double no_small_angle = 0;
/// The segment runs so close beside another that it may get no vertices at all.
inline constexpr double no_vertices = std::numeric_limits<double>::infinity();

/// May pieces of this length end at this distance from the end of a segment? Two segments with a small angle are r sin
/// apart at a distance r, and vertices there fit pieces of length l if their distances differ by at most (r sin)^2 / l.
inline bool may_end_at(double distance, double least, double length) {
  return distance * distance >= least * std::min(length, distance);
}

/// \return  for each segment of the PLC, in grid units
std::vector<LeastDistances> find_close_segments(const plc::Plc& plc);

}  // namespace ccdt::refine
