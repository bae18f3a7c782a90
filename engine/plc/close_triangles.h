#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/box_tree.h"
#include "engine/plc/edge_table.h"

namespace ccdt::plc {

/// The tree of the boxes of triangles.
BoxTree tree_of(std::span<const Point3> vertices, const TriangleSet& triangles);

/// Two different triangles, by their indices.
struct TrianglePair {
  std::uint32_t first, second;
};

/// All pairs of triangles that may have more in common than corners and edges of both. Most pairs whose boxes meet are
/// neighbors, and floating point shows that one triangle is on one side of the other's plane or, if both are in one
/// plane, of the line of one of its edges. These pairs are left out.
///
/// \param triangles    with an area
/// \param is_doubtful  by triangle: pairs of two that are not doubtful are left out as well; empty: all are doubtful
std::vector<TrianglePair> find_close_triangles(std::span<const Point3> vertices, const TriangleSet& triangles,
                                               std::span<const std::uint8_t> is_doubtful = {});

}  // namespace ccdt::plc
