#pragma once

#include <span>

#include "bench/verify/surface.h"

namespace ccdt::verification {

/// For each of a list of straight edges between sites, the vertices of the chain of mesh edges along it, both ends
/// included; none where the mesh has no such chain.
struct Chains {
  std::vector<std::uint32_t> begin = {0}, vertices;

  std::span<const std::uint32_t> of(std::size_t edge) const {
    return std::span(vertices).subspan(begin[edge], begin[edge + 1] - begin[edge]);
  }
  bool missing(std::size_t edge) const { return begin[edge] == begin[edge + 1]; }
};

/// A vertex is on an edge if it is within `tolerances.place` of it.
Chains find_chains(const TetMesh& mesh, const Topology& topology, const Surface& surface,
                   std::span<const std::array<std::uint32_t, 2>> edges);

}  // namespace ccdt::verification
