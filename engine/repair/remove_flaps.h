#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// Removes triangles that hang from the surface and bound nothing: their open edges end at an edge of several
/// triangles, instead of going around a hole. All triangles connected to these across edges with two triangles are
/// removed, too, and so are triangles that are connected to nothing.
///
/// \return  the number of removed triangles
std::size_t remove_flaps(plc::UncheckedPlc& soup);

}  // namespace ccdt::repair
