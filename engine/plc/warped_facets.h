#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/base/point.h"
#include "engine/plc/input.h"

namespace ccdt::plc {

/// The plane through three points of a facet that are far apart.
struct FacetPlane {
  Point3 normal;             ///< of any length; zero if all points are on one line
  double deviation = 0;      ///< largest distance of the points from the plane in the middle
  std::size_t farthest = 0;  ///< the index of a point at that distance
};

/// \param points  on the dyadic grid, in grid units; not empty
FacetPlane find_plane(std::span<const Point3> points);

/// Replaces each polygon facet that is not planar within the tolerance of `PlcOptions` by triangles, so that all
/// meshers agree on its meaning. The triangles keep the facet's number and marker.
///
/// A polygon of up to 64 corners is triangulated so that it bends least: the largest angle between the normals of
/// neighboring triangles is the smallest possible, found by dynamic programming (as for filling holes: Barequet &
/// Sharir 1995, Liepa 2003; here the search is complete). Triangles that are folded over, seen along the facet's
/// normal, or that equal another facet of the input count as worse than any bend; among equals, the shortest diagonals
/// win. Larger polygons and facets of several polygons get the constrained Delaunay triangulation of their projection
/// along the normal.
///
/// A polygon that meets one vertex twice is left as it is.
///
/// \return nothing if no facet had to be replaced; otherwise the new input, with updated `warped`
/// \throw InputError  a coordinate that is not finite; edges of a large facet cross each other
std::optional<InputPlc> triangulate_warped_facets(const InputPlc& input);

}  // namespace ccdt::plc
