#pragma once

#include <set>
#include <span>

#include "bench/verify/topology.h"
#include "engine/plc/input.h"

namespace ccdt::verify {

/// A part of a facet without inner edges: the directed edges of its outer loop and of the loops of what is cut out of
/// it, with the cell to their left.
using PolygonCell = std::vector<Edge>;

/// The faces of a planar drawing.
struct DrawnLoops {
  std::vector<PolygonCell> loops;  ///< closed walks, each with a face to its left
  std::vector<double> areas;       ///< of each loop; positive if it is the outer loop of its face
  std::vector<PolygonCell> cells;  ///< of each outer loop: with the loops of what lies within
};

/// \param normal      of the plane, from the side that it is seen from
/// \param undirected  ascending
DrawnLoops trace_drawing(const Point3& normal, const std::set<Edge>& undirected, std::span<const Point3> position);

/// Is a point within a loop of edges, or an odd number of them, seen along the plane's normal?
bool encloses(const Point3& normal, std::span<const Edge> loop, std::span<const Point3> position, const Point3& point);

struct PolygonCells {
  std::vector<PolygonCell> cells;
  std::vector<Edge> segments;  ///< edges that the polygons draw within the facet
};

/// The cells into which the polygons of a facet divide their plane, without those that hold a hole's point.
///
/// \param site_of_input  names of the input's vertices
PolygonCells find_polygon_cells(const plc::PolygonFacet& facet, std::span<const std::uint32_t> site_of_input,
                                std::span<const Point3> position);

}  // namespace ccdt::verify
