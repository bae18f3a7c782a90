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
/// from a few candidates the one with the fewest points inside, and these points are left out. If rounding errors
/// forbid that, all points inside the circumspheres of the cells around the edge are left out.
///
/// \param points   interior points in grid units
/// \param surface  whose protected edges are all there
/// \return  the indices of the harmless points, in increasing order
std::vector<std::uint32_t> harmless_points(std::span<const Point3> points, const ProtectedDelaunay& surface);

}  // namespace ccdt::protection
