#pragma once

#include "engine/plc/input.h"

namespace ccdt::io {

/// Drops the walls of bridges from a surface. If a polygon runs around a hole by a bridge, there and back along one
/// edge, and the surface is that of an extruded polygon, then two facets with the same corners and opposite
/// orientations stand on the bridge. Nothing is between them, so they bound nothing. A note names them.
///
/// Other such pairs stay: two solids may touch there.
void drop_bridge_walls(plc::InputPlc& surface);

}  // namespace ccdt::io
