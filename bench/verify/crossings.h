#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/plc/input.h"

namespace ccdt::verify {

/// Pairs of triangles that meet outside their common vertices and edges, by number. Exact.
std::vector<std::array<std::uint32_t, 2>> find_crossings(const plc::InputPlc& surface);

}  // namespace ccdt::verify
