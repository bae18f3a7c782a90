#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/protection/protect_edges.h"

namespace ccdt::protection {

/// What points already keep away from.
enum class Avoided {
  nothing,
  smallest_spheres  ///< of all edges and triangles of the surface, and with them the vertices
};

/// Prepares a surface for the insertion of interior points: leaves out those that could destroy a protected edge, and
/// splits the edges that would cost too many. All protected edges then stay Delaunay, whichever of the remaining points
/// are inserted and in whatever order.
///
/// An edge is Delaunay if some sphere through its ends has no vertex inside. For each edge one such sphere is chosen,
/// the smallest one or, if it has few points and another one has fewer, that one. The points inside are left out. If
/// rounding errors rule this out, the circumsphere of a cell at the edge is used, and points are tested exactly.
///
/// On a bad surface, a vertex right beside an edge can force all spheres of the edge to be large; the spheres of its
/// halves are small. So edges are split, as long as each split saves 20 points.
///
/// \param points   in grid units
/// \param surface  whose protected edges are all there; gains the vertices of the splits, and stays protected
/// \param avoided  what the points are known to keep away from
/// \return  the indices of the points that remain, in increasing order; none of them is at a vertex
std::vector<std::uint32_t> make_room(std::span<const Point3> points, const plc::Plc& plc, Protection strategy,
                                     ProtectedDelaunay& surface, Avoided avoided, const Progress& progress = {});

}  // namespace ccdt::protection
