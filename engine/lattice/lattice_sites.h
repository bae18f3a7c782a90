#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/octree.h"
#include "engine/numbers/morton.h"

namespace ccdt {

/// A point of the lattice that may become a vertex: the Morton code of its octree coordinates.
using Site = std::uint64_t;

inline Site site_at(const std::array<std::uint32_t, 3>& c) {
  return spread_bits(c[0]) | spread_bits(c[1]) << 1 | spread_bits(c[2]) << 2;
}

inline std::array<std::uint32_t, 3> coordinates_of(Site site) {
  return {gather_bits(site), gather_bits(site >> 1), gather_bits(site >> 2)};
}

/// The lattice points of all leaves that are not outside, each once, in Morton order, and strictly within the bounds of
/// the surface. Those of leaves on the surface may be outside of the domain.
std::vector<Site> list_sites(const Octree& tree, Lattice kind);

}  // namespace ccdt
