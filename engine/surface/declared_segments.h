#pragma once

#include <vector>

#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/plc/triangle_set.h"

namespace ccdt {

/// The segments that the input itself names, among them the polygons of two vertices and the slits within its polygon
/// facets, split at all vertices that lie on them.
///
/// \param plc        of that input
/// \param tolerance  in grid units, as the PLC was built with
SegmentSet declared_segments(const InputPlc& input, const Plc& plc, double tolerance);

/// For each vertex of the PLC: the input lists it, but no facet or segment of the input has it as a corner.
std::vector<char> find_vertices_listed_alone(const InputPlc& input, const Plc& plc);

}  // namespace ccdt
