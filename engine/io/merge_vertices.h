#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/hash_table.h"
#include "engine/base/point.h"

namespace ccdt::io {

/// The coordinates of a point bit for bit: in single precision (Bits has 32 bits) or double precision (64 bits).
template <class Bits>
using PointBits = std::array<Bits, 3>;

/// Gives equal points one index. Formats that repeat a vertex for every triangle would need six times the memory
/// otherwise. 0 and -0 are equal. The points must be finite.
///
/// \tparam Real  what the file holds: float or double
template <class Real>
class VertexMerger {
 public:
  using Corner = std::array<Real, 3>;

  explicit VertexMerger(std::vector<Point3>& vertices) : vertices_(vertices) {}

  /// Prepares for about this many distinct points.
  void reserve(std::size_t points) {
    vertices_.reserve(points);
    indices_.reserve(points);
  }

  /// The index of the point in the list. A new point is added.
  std::uint32_t index_of(const Corner& corner) { return index_of(corner, bits_of(corner)); }

  /// The indices of many points. The table is large and the points are scattered in it, so all places are prefetched
  /// before the first one is read.
  void indices_of(std::span<const Corner> corners, std::span<std::uint32_t> indices) {
    for (const Corner& corner : corners) indices_.prefetch(bits_of(corner));
    std::ranges::transform(corners, indices.begin(), [&](const Corner& corner) { return index_of(corner); });
  }

 private:
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

  static PointBits<Bits> bits_of(const Corner& corner) {
    PointBits<Bits> bits;
    for (std::size_t axis = 0; axis < 3; ++axis) bits[axis] = std::bit_cast<Bits>(corner[axis] + Real{0});  // -0 to 0
    return bits;
  }
  std::uint32_t index_of(const Corner& corner, const PointBits<Bits>& bits) {
    const auto [index, is_new] = indices_.insert(bits, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back({corner[0] + 0.0, corner[1] + 0.0, corner[2] + 0.0});
    return *index;
  }

  std::vector<Point3>& vertices_;
  HashTable<PointBits<Bits>, std::uint32_t> indices_;
};

}  // namespace ccdt::io
