#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// A triangle to be cut, with new vertices on its edges.
struct DividedTriangle {
  plc::VertexTriple corners;
  std::array<std::vector<VertexId>, 3> on_edges;  ///< the vertices on the edge from this corner to the next, in order
  std::vector<std::array<VertexId, 2>> pieces;    ///< the edges that the parts must have; equal ends mean a vertex
};

/// What a triangle becomes. Its parts have the given outline, whatever else fails.
struct TriangleParts {
  std::vector<plc::VertexTriple> triangles;  ///< facing the same way; some may have no area
  /// Rounding has moved these vertices to or beyond the edge from this corner to the next. They should be on that edge.
  std::vector<std::pair<std::size_t, VertexId>> beyond_edges;
};

/// Triangulates a triangle with the vertices on its edges and with its pieces. Where rounding made pieces cross, some
/// of them are left out.
TriangleParts cut_triangle(std::span<const Point3> vertices, const DividedTriangle& triangle);

}  // namespace ccdt::repair
