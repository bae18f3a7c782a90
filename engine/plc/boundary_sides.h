#pragma once

#include <cstdint>
#include <vector>

#include "engine/plc/plc.h"

namespace ccdt::plc {

/// By segment: how many sides of facets with the domain on one side only meet there. With two, the domain around the
/// segment is connected; with more, it touches itself along the segment.
std::vector<std::uint32_t> count_boundary_sides(const Plc& plc);

}  // namespace ccdt::plc
