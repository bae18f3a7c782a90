#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/point.h"
#include "engine/base/raw_vector.h"

namespace ccdt {

/// Puts two zero bits between the bits of a 21-bit number.
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

/// The Morton code of three 21-bit coordinates: their bits interleaved, those of x lowest.
constexpr std::uint64_t morton_code(const std::array<std::uint32_t, 3>& c) {
  return spread_bits(c[0]) | spread_bits(c[1]) << 1 | spread_bits(c[2]) << 2;
}

/// The same for a point, whose coordinates are rounded down.
inline std::uint64_t morton_code_at(const Point3& p) {
  return spread_bits(static_cast<std::uint64_t>(p.x)) | spread_bits(static_cast<std::uint64_t>(p.y)) << 1 |
         spread_bits(static_cast<std::uint64_t>(p.z)) << 2;
}

/// The inverse of `morton_code`.
constexpr std::array<std::uint32_t, 3> coordinates_of_morton_code(std::uint64_t code) {
  return {gather_bits(code), gather_bits(code >> 1), gather_bits(code >> 2)};
}

/// An item and its place on a space-filling curve.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// The indices sorted by key, equal keys by index.
std::vector<std::uint32_t> sorted_by_key(RawVector<KeyedIndex> items);

/// The indices of points in Morton order, in a grid of 2^21 cells per side around them; points in one cell keep their
/// order.
std::vector<std::uint32_t> morton_order(std::span<const Point3> points);

}  // namespace ccdt
