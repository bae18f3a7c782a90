#pragma once

#include <set>
#include <span>

#include "bench/verify/sites.h"

namespace ccdt::verification {

/// A part of a facet without inner edges: the directed edges of its outer loop and of the loops of what is cut out of
/// it, with the cell to their left.
using Cell = std::vector<std::array<std::uint32_t, 2>>;

/// The faces of a planar drawing.
struct DrawnLoops {
  std::vector<Cell> loops;    ///< closed walks, each with a face to its left
  std::vector<double> areas;  ///< of each loop; positive if it is the outer loop of its face
  std::vector<Cell> cells;    ///< of each outer loop: with the loops of what lies within
};

/// \param normal      of the plane, from the side that it is seen from
/// \param undirected  ascending
DrawnLoops trace_drawing(const Point3& normal, const std::set<std::array<std::uint32_t, 2>>& undirected,
                         std::span<const Point3> position);

struct PolygonCells {
  std::vector<Cell> cells;
  std::vector<std::array<std::uint32_t, 2>> segments;  ///< edges that the polygons draw within the facet
};

/// The cells into which the polygons of a facet divide their plane, without those that hold a hole's point.
///
/// \param site_of_input  names of the input's vertices
PolygonCells find_polygon_cells(const PolygonFacet& facet, std::span<const std::uint32_t> site_of_input,
                                std::span<const Point3> position);

}  // namespace ccdt::verification
