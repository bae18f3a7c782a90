#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/octree.h"

namespace ccdt {

/// A point of the lattice that may become a vertex.
struct Site {
  std::uint64_t key;   ///< Morton code of its octree coordinates
  std::uint32_t leaf;  ///< a leaf that has it; one that is inside, if there is any

  std::array<std::uint32_t, 3> coordinates() const;
};

std::uint64_t morton_key(const std::array<std::uint32_t, 3>& coordinates);

/// The lattice points of all leaves that are not outside, each once, in Morton order, and strictly within the bounds of
/// the surface. Those of leaves on the surface may be outside of the domain.
std::vector<Site> list_sites(const Octree& tree, Lattice kind);

}  // namespace ccdt
