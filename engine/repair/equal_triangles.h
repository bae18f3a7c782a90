#pragma once

#include <cstddef>
#include <vector>

#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// Keeps some triangles, in their order.
/// \param is_kept  by triangle
void keep_triangles(const std::vector<char>& is_kept, plc::TriangleSet& triangles);

/// What remains of triangles with the same corners.
enum class Fins {
  keep,  ///< the first one
  drop   ///< the same, but of two that face opposite ways none, if an edge has no other triangle: they enclose nothing
};

/// Makes triangles pairwise different.
/// \return  the number of the dropped ones
std::size_t drop_equal_triangles(plc::TriangleSet& triangles, Fins fins);

}  // namespace ccdt::repair
