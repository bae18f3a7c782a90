#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/plc/input.h"

namespace ccdt {

/// Places, in the units of the surface, where triangles or segments of a surface meet in more than common vertices and
/// edges, or where a triangle has no area: all of them up to some thousands, unlike `build_plc`, which stops at the
/// first.
///
/// \param surface    triangles and segments only
/// \param flatness   see PlcOptions
std::vector<Point3> find_crossings(const InputPlc& surface, double flatness);

}  // namespace ccdt
