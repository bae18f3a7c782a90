#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/plc/input.h"

namespace ccdt::verify {

/// Pairs of triangles that meet anywhere but in vertices and edges that they share, by their numbers. Exact.
std::vector<std::array<std::uint32_t, 2>> find_crossings(const plc::InputPlc& surface);

}  // namespace ccdt::verify
