#pragma once

#include <cstdint>

#include "engine/plc/input.h"

namespace ccdt::fuzz {

/// Random boxes, tetrahedra, loose facets, segments and vertices whose coordinates form clusters: two of one cluster
/// differ by 1e-17 to 1e-5 of the whole. Facets may be degenerate, and most inputs are not valid. It is a surface, or
/// any PLC; at the origin or far from it. A seed gives the same input on every machine.
plc::InputPlc near_duplicates(std::uint64_t seed);

}  // namespace ccdt::fuzz
