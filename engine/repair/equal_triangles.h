#pragma once

#include <cstddef>
#include <vector>

#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// What remains of triangles with the same corners.
enum class Fins {
  keep,  ///< the first one
  drop   ///< the same, but of two that face opposite ways none, if an edge has no other triangle: they enclose nothing
};

/// Makes triangles pairwise different.
/// \return  the number of the dropped ones
std::size_t drop_equal_triangles(plc::TriangleSet& triangles, Fins fins);

}  // namespace ccdt::repair
