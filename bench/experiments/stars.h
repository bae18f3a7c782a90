#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// Segments or fins that meet at one point inside a cube, at a given angle: inputs that are hard to protect.
struct Star {
  std::string_view name;
  std::string_view what;      ///< one sentence
  double smallest_angle = 1;  ///< in degrees; below it there would be too many segments
  InputPlc (*make)(double degrees, std::uint64_t variant);
};

/// Variant 0 has lengths that alternate between 1 and 1 / sqrt 2; the other variants have random ones between 0.4 and
/// 1.6. A segment all around which shorter ones end is missing if these are shorter than its length times the cosine of
/// the angle. Halves of 1 and 1 / sqrt 2 stay in that proportion for ever, so below 45 degrees they can split each
/// other without end.
std::span<const Star> stars();

/// In degrees, of two segments that meet; 180 if there are none.
double smallest_angle(const Plc& plc);

}  // namespace ccdt
