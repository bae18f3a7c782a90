#pragma once

#include <cstdint>

#include "engine/plc/input.h"
#include "tests/fuzz/scene.h"

namespace ccdt::fuzz {

/// A random piecewise linear complex with structure: a body of grid cells, plates, combs or screws, which may contain
/// facets, fans, bundles and stars of segments, slits and vertices. It has few different coordinates. A seed gives the
/// same complex on every machine.
///
/// A body that contains nothing may be rotated, or roughened so that its facets are flat only within the tolerance.
/// Other bodies stay as they are: the parts in them touch each other exactly. After a rotation, some parts would only
/// nearly touch, and the meaning of the input would be unclear.
plc::InputPlc structured_plc(std::uint64_t seed);

/// The same with any random numbers.
plc::InputPlc structured_plc(Random& random);

}  // namespace ccdt::fuzz
