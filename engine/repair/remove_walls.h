#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"
#include "engine/repair/winding_number.h"

namespace ccdt::repair {

/// Removes the facets inside the domain that divide parts around which a surface goes a different number of times:
/// there, two solids overlap, and what is left is their union. Facets between parts with the same number stay, as
/// between two solids that touch.
///
/// \param soup    without crossings
/// \param given   the surface before it was cut at its crossings
/// \return  the number of removed triangles
/// \throw InputError  the soup is not a valid PLC
std::size_t remove_walls(plc::UncheckedPlc& soup, const OrientedSurface& given, const plc::InputPlc& input,
                         const plc::PlcOptions& options);

}  // namespace ccdt::repair
