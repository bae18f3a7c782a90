#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/cores/site_blocks.h"

namespace ccdt::cores {

/// Does the lattice have shapes in unit cubes?
constexpr bool has_cubes(Lattice kind) {
  return kind == Lattice::fcc || kind == Lattice::sc;
}

/// Does the lattice have a shape around this place? Blocks begin at even places, so places relative to a block are
/// enough.
constexpr bool has_shape_at(Lattice kind, const Place& p) {
  const unsigned odd = (p[0] & 1) + (p[1] & 1) + (p[2] & 1);
  return kind == Lattice::fcc ? (odd & 1) != 0 : kind == Lattice::bcc && odd == 2;
}

/// The axis of the only even coordinate.
constexpr int even_axis(const Place& p) {
  return (p[0] & 1) == 0 ? 0 : (p[1] & 1) == 0 ? 1 : 2;
}

/// Six vertices on one sphere at the ends of three diagonals are split around one diagonal. With the raised heights, it
/// is the diagonal that is lowest in the middle: the one whose greater rank is least.
///
/// \param v  ranks, those of one diagonal next to each other
constexpr int diagonal_of_octahedron(const std::uint32_t* v) {
  const auto greater = [&](int k) { return v[2 * k] > v[2 * k + 1] ? v[2 * k] : v[2 * k + 1]; };
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (greater(k) < greater(least)) least = k;
  return least;
}

/// How a cube is split into tetrahedra. Corners are named by their bits x, y, z; a face by the bits of its corners.
struct CubeSplit {
  std::uint8_t count = 0;                            ///< 5 or 6
  std::array<std::array<std::uint8_t, 4>, 6> cells;  ///< positively oriented
  /// By cell and face: the code 4 * cell + face of the same face in the cell on its other side; `outer_face` on the
  /// cube's surface.
  std::array<std::uint8_t, 24> neighbors;
  std::array<std::uint8_t, 256> outer;  ///< the code of a face on the surface, by its corners

  static constexpr std::uint8_t outer_face = 0xFF;
};

inline constexpr std::size_t most_kinds = 70;

/// How ranks split a cube. Several threads may ask at the same time.
///
/// \param ranks  of its corners, all different
/// \return       for `split_of_kind`, less than `most_kinds`
std::uint8_t kind_of_cube(const std::array<std::uint32_t, 8>& ranks);

const CubeSplit& split_of_kind(std::uint8_t kind);

}  // namespace ccdt::cores
