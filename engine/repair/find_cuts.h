#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/exact_points.h"
#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// Where a triangle must be cut, because another triangle is there.
struct Cut {
  /// The cut is not along an edge, but where the plane of the other triangle is.
  static constexpr int in_plane = -1;

  std::uint32_t triangle;  ///< that is cut
  std::uint32_t by;        ///< the other triangle
  int edge = in_plane;     ///< if both are in one plane: the cut is along the edge of `by` from this corner to the next
  std::array<ExactPoint, 2> ends;  ///< equal if the triangles only touch in a point
};

/// The cuts of all pairs of triangles that share more than corners and edges. Triangles in one plane that meet across a
/// common edge do not count unless they are folded over each other.
struct Cuts {
  std::size_t pairs = 0;
  std::vector<Cut> cuts;  ///< in the order of the pairs
};

/// \param triangles  distinct, with an area, and with no vertex of others on them
/// \param close      of the triangles
Cuts find_cuts(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
               std::span<const plc::TrianglePair> close);

}  // namespace ccdt::repair
