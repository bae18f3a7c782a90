#pragma once

#include <vector>

#include "engine/plc/plc.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// The range of edge lengths that a rule may ask for.
struct LengthRange {
  double least, most;
};

/// Lists the segments within curved surfaces: those between two facets at a small angle. The length there spans an
/// angle on a circle whose radius is the mean height of the two triangles at the segment, over the angle between them.
///
/// \param angle  that edges span, in radians
/// \param sharp  in radians: at a greater angle, a segment is not within a curved surface
void add_curved_edges(const plc::Plc& plc, double angle, double sharp, const LengthRange& lengths,
                      std::vector<SizedPlace>& places);

}  // namespace ccdt::sizes
