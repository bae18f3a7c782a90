#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/numbers/point.h"

namespace ccdt {

/// Puts two zero bits between the bits of a number of 21 bits.
constexpr std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFu;
  x = (x | x << 16) & 0x001F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

/// The inverse of `spread_bits`; ignores the bits between.
constexpr std::uint32_t gather_bits(std::uint64_t x) {
  x &= 0x1249249249249249u;
  x = (x | x >> 2) & 0x10C30C30C30C30C3u;
  x = (x | x >> 4) & 0x100F00F00F00F00Fu;
  x = (x | x >> 8) & 0x001F0000FF0000FFu;
  x = (x | x >> 16) & 0x001F00000000FFFFu;
  return static_cast<std::uint32_t>(x | x >> 32);
}

/// The indices of points in Morton order, in a grid of 2^21 cells a side around them; those of one cell in the order
/// that they are given in.
std::vector<std::uint32_t> morton_order(std::span<const Point3> points);

}  // namespace ccdt
