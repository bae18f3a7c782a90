#pragma once

#include <cstddef>
#include <vector>

#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// What remains of triangles with the same corners.
enum class Fins {
  keep,  ///< the first one
  drop   ///< the first one; but neither of two opposite ones if an edge has no other triangle: they enclose nothing
};

/// Makes triangles pairwise distinct.
/// \return  how many were dropped
std::size_t drop_equal_triangles(plc::TriangleSet& triangles, Fins fins);

}  // namespace ccdt::repair
