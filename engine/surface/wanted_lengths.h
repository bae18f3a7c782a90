#pragma once

#include "engine/surface/working_mesh.h"

namespace ccdt {

/// Gives every vertex and knot the edge length that is wanted there (`EdgeLengths`), but less around edges that are
/// much shorter and could not be collapsed, because the surface is too narrow or too strongly curved there: long edges
/// beside them would make needles of the triangles.
void find_wanted_lengths(WorkingMesh& m);

}  // namespace ccdt
