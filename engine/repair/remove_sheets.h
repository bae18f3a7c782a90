#pragma once

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// Removes parts that are open and small beside the closed ones. Parts are connected by edges.
///
/// \return  the removed triangles
plc::TriangleSet remove_sheets(plc::UncheckedPlc& soup);

/// Are all parts open and flat within the tolerance? Then they enclose nothing, however their holes are filled.
///
/// \param tolerance  in grid units
bool are_flat_sheets(const plc::UncheckedPlc& soup, double tolerance);

}  // namespace ccdt::repair
