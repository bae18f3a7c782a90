#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <utility>

#include "engine/base/point.h"
#include "engine/tests/shared/sanitized.h"

namespace ccdt::test {

using Random = std::mt19937_64;

/// The largest coordinate of the dyadic grid (engine/geometry/grid.h).
inline constexpr std::int64_t largest_coordinate = (std::int64_t{1} << 51) + (1 << 20);

/// Ways to draw points on which signs are hard to tell, or zero.
enum class Family : std::uint8_t {
  anywhere,         ///< the whole grid
  box_of_any_size,  ///< a box of another power of two in each direction, somewhere
  extremes,         ///< the largest coordinates and their neighbors
  lattice,          ///< a few steps of a lattice, of a random power of two
  plane,            ///< small multiples of two vectors: in one plane, often on one line
  segments,         ///< dyadic fractions of two segments
  sphere,           ///< a vector with its coordinates permuted and their signs changed: on one sphere
};
inline constexpr std::array all_families = {Family::anywhere, Family::box_of_any_size, Family::extremes,
                                            Family::lattice,  Family::plane,           Family::segments,
                                            Family::sphere};

/// The number of cases of a test: all in a release build, fewer where code is slow on purpose.
inline constexpr int cases(int in_release) {
#ifdef NDEBUG
  return is_sanitized ? in_release / 100 : in_release;
#else
  return in_release / 100;
#endif
}

inline std::int64_t draw_between(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

/// Six points of a family. In every other case one of them is moved by one unit or one quantum of the grid.
std::array<Point3, 6> draw_points(Random& random, Family family);

/// Different ranks in random order, the smallest and the largest possible ones among them.
template <std::size_t n>
std::array<std::uint32_t, n> draw_ranks(Random& random) {
  std::array<std::uint32_t, n> ranks;
  for (std::size_t i = 0; i < n; ++i) {
    const auto spread = static_cast<std::uint32_t>(random() % 3);
    const auto k = static_cast<std::uint32_t>(i);
    ranks[i] = spread == 0   ? k
               : spread == 1 ? 1000000 * (k + 1) + static_cast<std::uint32_t>(random() % 1000000)
                             : 0xFFFFFFFEu - k;
  }
  for (std::size_t i = n - 1; i > 0; --i) std::swap(ranks[i], ranks[random() % (i + 1)]);
  return ranks;
}

}  // namespace ccdt::test
