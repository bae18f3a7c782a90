#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/domain_surface.h"
#include "engine/lattice/octree.h"
#include "engine/lattice/options.h"
#include "engine/lattice/sites.h"

namespace ccdt::lattice {

/// Finds the sites that are too near the surface: in the smallest ball of a triangle or a subsegment, its radius times
/// `options.sphere_factor` (paper, section 3; Cavendish, Field and Frey 1985), or within `options.clearance` times the
/// edge length of their lattice cell of a triangle, a subsegment or a vertex.
///
/// \param sites  of the tree, in Morton order
/// \return       for each site: does it stay?
std::vector<std::uint8_t> find_clear_sites(const Octree& tree, const DomainSurface& surface,
                                           const std::vector<Site>& sites, const LatticeOptions& options);

}  // namespace ccdt::lattice
