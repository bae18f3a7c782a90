#pragma once

#include <vector>

#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// Adds the places that repeat others beyond the sides of a periodic PLC, so that sizes are equal on opposite sides.
/// Those too far away to matter are left out.
void repeat_places(const plc::Plc& plc, double largest, double grading, std::vector<SizedPlace>& places);

}  // namespace ccdt::sizes
