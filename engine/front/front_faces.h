#pragma once

#include <array>
#include <cstdint>

#include "engine/base/index.h"
#include "engine/delaunay/delaunay.h"

namespace ccdt {

/// An oriented face by its corners, the smallest first. What is above it waits to be filled.
struct OrientedFace {
  std::array<std::uint32_t, 3> corners;

  OrientedFace(std::uint32_t a, std::uint32_t b, std::uint32_t c)
      : corners(a < b && a < c ? std::array{a, b, c}
                : b < c        ? std::array{b, c, a}
                               : std::array{c, a, b}) {}

  OrientedFace reversed() const { return {corners[0], corners[2], corners[1]}; }
  // Inline; that of std::array calls memcmp.
  friend bool operator==(const OrientedFace& f, const OrientedFace& g) {
    return f.corners[0] == g.corners[0] && f.corners[1] == g.corners[1] && f.corners[2] == g.corners[2];
  }
};

/// For tables.
struct OrientedFaceTraits {
  static OrientedFace none() { return {ghost_vertex, ghost_vertex, ghost_vertex}; }
  static std::size_t hash(const OrientedFace& f) {
    std::uint64_t h =
        f.corners[0] * 0x9E3779B97F4A7C15u ^ f.corners[1] * 0xC2B2AE3D27D4EB4Fu ^ f.corners[2] * 0x165667B19E3779F9u;
    h ^= h >> 32;
    h *= 0xD6E8FEB86659FD93u;
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};

/// What the front knows of one of its faces.
struct FrontFace {
  RegionId region;                   ///< the part of the domain above it
  std::uint32_t code = no_neighbor;  ///< its code in the Delaunay cell above it; `no_neighbor` if it is undelaunay
};

}  // namespace ccdt
