#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"
#include "engine/repair/winding_number.h"

namespace ccdt::repair {

/// Removes the facets inside the domain that divide parts with different winding numbers: there, two solids overlap,
/// and their union is left. Facets within such an overlap go, too. Facets between two solids that touch stay.
///
/// \param soup    without crossings
/// \param given   the surface before it was cut at its crossings
/// \return  the number of removed triangles
/// \throw InputError  the soup is not a valid PLC
std::size_t remove_walls(plc::UncheckedPlc& soup, const OrientedSurface& given, const plc::InputPlc& input,
                         const plc::PlcOptions& options);

}  // namespace ccdt::repair
