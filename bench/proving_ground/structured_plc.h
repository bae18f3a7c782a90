#pragma once

#include <cstdint>

#include "engine/plc/input.h"

namespace ccdt::proving_ground {

/// A random piecewise linear complex with structure: a body of grid cells, plates, combs or screws, in it facets,
/// fans, bundles and stars of segments, slits and vertices, with few different coordinates. The same for a seed on
/// every machine.
///
/// A body alone may be rotated, or roughened so that its facets are flat only within the tolerance. Things within it
/// touch each other exactly; moved, some of them would touch only nearly, and then not even what the input means is
/// certain.
plc::InputPlc structured_plc(std::uint64_t seed);

}  // namespace ccdt::proving_ground
