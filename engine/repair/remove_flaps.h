#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// Removes triangles that hang on the surface and bound nothing: their open edges end at an edge of several triangles,
/// instead of going around a hole. With them go all those that are connected to them by edges of two triangles.
/// Triangles that are connected to nothing go as well.
///
/// \return  the number of removed triangles
std::size_t remove_flaps(plc::UncheckedPlc& soup);

}  // namespace ccdt::repair
