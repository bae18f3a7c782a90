#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/lattice_sites.h"

namespace ccdt {

/// Points nearer to the surface than this times the edge length of their lattice cell are dropped. See the table in
/// clear_surface.cpp.
extern const double least_distance_to_surface;

/// A ball that a surface triangle or a subsegment wants empty.
struct Ball {
  Point3 centre;
  double radius;
};

/// The smallest ball around a triangle (the paper's minimal circumsphere), a hair larger, so that a point on the sphere
/// is in it.
Ball smallest_ball(const Corners& triangle);
/// The smallest ball around a segment, a hair larger.
Ball smallest_ball(const Point3& a, const Point3& b);

/// Finds the sites that are too near to the surface: in the smallest ball of a triangle or a subsegment (paper, section
/// 3; Cavendish, Field and Frey 1985), or nearer than `least_distance_to_surface` to a triangle, a subsegment or a
/// vertex.
///
/// \param sites  of the tree, in Morton order
/// \return       for each site: does it stay?
std::vector<bool> find_clear_sites(const Octree& tree, const Surface& surface, const std::vector<Site>& sites,
                                   Lattice kind);

}  // namespace ccdt
