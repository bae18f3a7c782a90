#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/protection/protect_edges.h"

namespace ccdt::protection {

/// Finds the points that leave all protected edges Delaunay, whichever of them are inserted and in whatever order, and
/// that are not where a vertex is.
///
/// An edge is Delaunay if some sphere through its ends has no vertex inside. For each edge one such sphere is chosen,
/// the smallest one or, if that spares some of a few points, another one. The points inside are left out. If rounding
/// errors forbid that, all points inside the circumspheres of the cells around the edge are left out.
///
/// \param points   interior points in grid units
/// \param surface  whose protected edges are all there
/// \return  the indices of the harmless points, in increasing order
std::vector<std::uint32_t> harmless_points(std::span<const Point3> points, const ProtectedDelaunay& surface);

/// Splits protected edges whose spheres hold many points, as long as each split spares 20 of them. On a bad surface, a
/// vertex right beside an edge can force all spheres of the edge to be large; those of two halves are small.
///
/// \param points   in grid units, as above
/// \param surface  gains the vertices of the splits, and stays protected
/// \return  the indices of the harmless points, in increasing order
std::vector<std::uint32_t> split_costly_edges(std::span<const Point3> points, const plc::Plc& plc, Protection strategy,
                                              ProtectedDelaunay& surface, const Progress& progress = {});

}  // namespace ccdt::protection
