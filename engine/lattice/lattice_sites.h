#pragma once

#include <cstdint>
#include <vector>

#include "engine/lattice/octree.h"

namespace ccdt {

/// A point of the lattice that may become a vertex: the Morton code of its octree coordinates.
using Site = std::uint64_t;

/// Puts two zero bits between the bits of a number of 21 bits.
inline std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFu;
  x = (x | x << 16) & 0x001F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

/// The inverse of `spread_bits`; ignores the bits between.
inline std::uint32_t gather_bits(std::uint64_t x) {
  x &= 0x1249249249249249u;
  x = (x | x >> 2) & 0x10C30C30C30C30C3u;
  x = (x | x >> 4) & 0x100F00F00F00F00Fu;
  x = (x | x >> 8) & 0x001F0000FF0000FFu;
  x = (x | x >> 16) & 0x001F00000000FFFFu;
  return static_cast<std::uint32_t>(x | x >> 32);
}

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
