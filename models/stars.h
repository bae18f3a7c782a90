#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "engine/base/point.h"
#include "engine/plc/input.h"

namespace ccdt::models {

/// Segments or fins that meet at one point inside a cube, at a given angle: inputs that are hard to protect.
struct Star {
  std::string_view name;
  std::string_view what;                              ///< one sentence
  double smallest_angle;                              ///< in degrees; below it there would be too many segments
  bool has_fins;                                      ///< triangles at a common edge, not segments
  std::vector<Point3> (*directions)(double degrees);  ///< of the segments, or of the tips of the fins; unit vectors
};
std::span<const Star> stars();

/// Variant 0 has lengths that alternate between 1 and 1 / sqrt 2; the other variants have random ones between 0.4 and
/// 1.6. A segment with shorter ones all around it is missing from the Delaunay tetrahedralization if these are shorter
/// than its length times the cosine of the angle. Halves of 1 and 1 / sqrt 2 stay in that proportion, so below 45
/// degrees they can split each other forever.
plc::InputPlc make_star(const Star& star, double degrees, std::uint64_t variant);

}  // namespace ccdt::models
