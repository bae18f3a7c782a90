#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/lattice_sites.h"

namespace ccdt {

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

/// Finds the sites that are too near to the surface: in the smallest ball of a triangle or a subsegment, its radius
/// times `options.sphere_factor` (paper, section 3; Cavendish, Field and Frey 1985), or not farther from a triangle, a
/// subsegment or a vertex than `options.clearance` times the edge length of their lattice cell.
///
/// \param sites  of the tree, in Morton order
/// \return       for each site: does it stay?
std::vector<bool> find_clear_sites(const Octree& tree, const Surface& surface, const std::vector<Site>& sites,
                                   const LatticeOptions& options);

}  // namespace ccdt
