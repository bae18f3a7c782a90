#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/morton.h"
#include "engine/lattice/octree.h"

namespace ccdt {

/// A point of the lattice that may become a vertex: the Morton code of its octree coordinates.
using Site = std::uint64_t;

inline Site site_at(const std::array<std::uint32_t, 3>& c) {
  return morton_code(c);
}

inline std::array<std::uint32_t, 3> coordinates_of(Site site) {
  return coordinates_of_morton_code(site);
}

/// The lattice points of all leaves that are not outside, each once, in Morton order, and strictly within the bounds of
/// the surface. Those of leaves on the surface may be outside of the domain.
std::vector<Site> list_sites(const Octree& tree, Lattice kind);

}  // namespace ccdt
