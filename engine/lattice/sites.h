#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/morton.h"
#include "engine/lattice/octree.h"
#include "engine/lattice/options.h"

namespace ccdt::lattice {

/// A point of the lattice that may become a vertex: the Morton code of its octree coordinates.
using Site = std::uint64_t;

inline Site site_at(const std::array<std::uint32_t, 3>& c) {
  return morton_code(c);
}

inline std::array<std::uint32_t, 3> coordinates_of(Site site) {
  return coordinates_of_morton_code(site);
}

/// How many rounds follow a site's round if a lattice is inserted in rounds from coarse to fine. The simple cubic
/// lattice with steps of 2^k octree units is part of a face-centered one, which is part of the simple cubic lattice
/// with half the step, and so on. Each of these lattices begins a round. The centers of the body-centered lattice come
/// last.
///
/// \param log_step  the coordinates of the sites around are multiples of 2 to this power
constexpr std::uint8_t later_rounds(Site site, unsigned log_step) {
  const unsigned zeros = static_cast<unsigned>(std::countr_zero(site)) / 3;
  const bool even = std::popcount(site >> 3 * zeros & 7) % 2 == 0;
  return static_cast<std::uint8_t>(2 * (zeros - std::min(zeros, log_step)) + (even ? 1 : 0));
}

/// The lattice points of all leaves that are not outside, each once, in Morton order, and strictly within the bounds of
/// the surface. Those on the lower faces of outside leaves are left out. Those of leaves on the surface may be outside
/// the domain.
std::vector<Site> list_sites(const Octree& tree, Lattice kind);

}  // namespace ccdt::lattice
