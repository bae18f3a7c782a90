#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/geometry/grid.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// At what distance things should touch, in grid units.
struct WeldReach {
  double edges = 4 * DyadicGrid::quantum;  ///< vertices and edges at edges and triangles. Rounding moves each
                                           ///< point by less than a quantum
  double vertices = 2 * edges;             ///< greater, so a vertex that should be on an edge is not near its end
};

/// A part of an edge, or a vertex (if a = b), that would be within a triangle without the rounding to the grid.
struct WeldedEdge {
  std::uint32_t triangle;
  VertexId a, b;    ///< of the edge
  Point3 from, to;  ///< of the part, in the order of a walk along the edge from a to b
};

/// Things so near each other that they should have been at the same place.
struct Welds {
  std::vector<std::array<VertexId, 2>> equal;              ///< vertices that should be one
  std::vector<std::pair<std::uint64_t, Point3>> on_edges;  ///< edges (`edge_key`), and points that should be on them
  std::vector<WeldedEdge> in_triangles;

  std::size_t size() const { return equal.size() + on_edges.size() + in_triangles.size(); }
  bool empty() const { return size() == 0; }
};

/// Finds triangles that would touch or cover each other on an infinitely fine grid, but do not on this one.
///
/// In such places the exact intersections are accidental: cutting along them makes ever more tiny triangles.
///
/// \param is_near  by vertex: only triangles with such a corner are looked at
Welds find_welds(std::span<const Point3> vertices, const plc::TriangleSet& triangles,
                 const std::vector<std::uint8_t>& is_near, const WeldReach& reach);

}  // namespace ccdt::repair
