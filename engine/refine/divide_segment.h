#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/point.h"
#include "engine/protection/segment_chains.h"
#include "engine/refine/close_segments.h"
#include "engine/sizes/size_field.h"

namespace ccdt::refine {

/// Fractions of segments are counted in this many steps, whose ends are on the grid on every segment.
inline constexpr std::uint32_t all_steps = protection::whole_segment / protection::usual_step;

/// A point on the segment between two points whose coordinates are multiples of 2^20; exact.
inline Point3 at_fraction(const std::array<Point3, 2>& ends, std::uint32_t fraction) {
  return ends[0] + fraction * ((1.0 / all_steps) * (ends[1] - ends[0]));
}

/// Chooses where a segment gets vertices, so that its pieces have about the wanted lengths: at nearly equal intervals,
/// or on shells if an end has a small angle.
///
/// \param least  how near to each end vertices may be
/// \return  fractions, in increasing order
std::vector<std::uint32_t> divide_segment(const std::array<Point3, 2>& ends, const LeastDistances& least,
                                          sizes::SizeWalk& sizes);

}  // namespace ccdt::refine
