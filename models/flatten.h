#pragma once

#include "engine/plc/input.h"

namespace ccdt::models {

/// Multiplies all z by a factor. The surfaces of our solids are so even that all their edges and faces are Delaunay;
/// flattened, many triangles are thin, and many edges and faces missing.
void flatten(plc::InputPlc& plc, double factor);

}  // namespace ccdt::models
