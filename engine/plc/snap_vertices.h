#pragma once

#include "engine/plc/input.h"
#include "engine/plc/plc.h"

namespace ccdt {

/// Fills the grid, the vertices and all that belongs to them: puts the vertices of the input on the dyadic grid and
/// makes those that fall on the same point one. Ids are given in the order of first appearance.
///
/// \throw InputError  a coordinate that is not finite, with the number of its vertex
void snap_vertices(const InputPlc& input, Plc& plc);

}  // namespace ccdt
