#include "engine/cores/split_by_rank.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt::cores {
namespace {

using CellCorners = std::array<std::uint8_t, 4>;

constexpr int bit(unsigned corner, unsigned axis) {
  return static_cast<int>(corner >> axis & 1);
}

/// The sign of `orient3d` for corners of the unit cube.
constexpr int orientation(unsigned a, unsigned b, unsigned c, unsigned d) {
  const auto row = [a](unsigned v) {
    return std::array{bit(v, 0) - bit(a, 0), bit(v, 1) - bit(a, 1), bit(v, 2) - bit(a, 2)};
  };
  const auto p = row(b), q = row(c), r = row(d);
  const int det =
      p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
  return (det > 0) - (det < 0);
}

/// Is e outside the perturbed sphere of a positively oriented cell? The same answer as `insphere_perturbed` for points
/// on one sphere.
bool is_outside(const CellCorners& cell, std::uint8_t e, const std::array<std::uint8_t, 8>& place) {
  std::array<std::uint8_t, 5> by_rank = {0, 1, 2, 3, 4};
  const auto place_of = [&](std::uint8_t i) { return place[i < 4 ? cell[i] : e]; };
  std::ranges::sort(by_rank, [&](std::uint8_t i, std::uint8_t j) { return place_of(i) > place_of(j); });
  for (const std::uint8_t i : by_rank) {
    if (i == 4) return true;  // the factor of its height is minus the cell's volume
    CellCorners with = cell;
    with[i] = e;
    if (const int sign = orientation(with[0], with[1], with[2], with[3]); sign != 0) return sign < 0;
  }
  return true;
}

unsigned face_mask(const CellCorners& cell, std::uint32_t f) {
  unsigned mask = 0;
  for (const std::uint32_t v : delaunay::corners_of_face({cell[0], cell[1], cell[2], cell[3]}, f)) mask |= 1u << v;
  return mask;
}

/// \param place  the place of each corner in the order of ranks
CubeSplit split_cube(const std::array<std::uint8_t, 8>& place) {
  CubeSplit split{};  // unused cells are zero, so that equal splits compare equal
  for (std::uint8_t a = 0; a < 8; ++a)
    for (std::uint8_t b = a + 1; b < 8; ++b)
      for (std::uint8_t c = b + 1; c < 8; ++c)
        for (std::uint8_t d = c + 1; d < 8; ++d) {
          const int sign = orientation(a, b, c, d);
          if (sign == 0) continue;
          const CellCorners cell = sign > 0 ? CellCorners{a, b, c, d} : CellCorners{a, b, d, c};
          bool is_cell = true;
          for (std::uint8_t e = 0; e < 8 && is_cell; ++e)
            is_cell = std::ranges::find(cell, e) != cell.end() || is_outside(cell, e, place);
          if (is_cell) split.cells[split.count++] = cell;
        }
  split.neighbors.fill(CubeSplit::outer_face);
  split.outer.fill(CubeSplit::outer_face);
  const unsigned codes = 4u * split.count;
  for (unsigned i = 0; i < codes; ++i) {
    const unsigned mask = face_mask(split.cells[i / 4], i % 4);
    for (unsigned j = 0; j < codes; ++j)
      if (j != i && face_mask(split.cells[j / 4], j % 4) == mask) split.neighbors[i] = static_cast<std::uint8_t>(j);
    if (split.neighbors[i] == CubeSplit::outer_face) split.outer[mask] = static_cast<std::uint8_t>(i);
  }
  return split;
}

/// The kinds by the order of ranks, shared by all threads; each is computed when first needed.
class KindTable {
 public:
  KindTable() : kind_of_order_(40320) {
    for (auto& kind : kind_of_order_) kind = unknown;
  }

  /// \param order  the number of the order of ranks
  /// \param place  the place of each corner in that order
  std::uint8_t kind(std::size_t order, const std::array<std::uint8_t, 8>& place) {
    std::atomic<std::uint8_t>& its = kind_of_order_[order];
    std::uint8_t kind = its.load(std::memory_order_acquire);
    if (kind == unknown) {
      kind = find(split_cube(place));
      its.store(kind, std::memory_order_release);
    }
    return kind;
  }
  const CubeSplit& split(std::uint8_t kind) const { return splits_[kind]; }

 private:
  static constexpr std::uint8_t unknown = 0xFF;

  std::uint8_t find(const CubeSplit& split) {
    const std::lock_guard lock(mutex_);
    for (std::uint8_t k = 0; k < count_; ++k)
      if (splits_[k].count == split.count && splits_[k].cells == split.cells) return k;
    splits_[count_] = split;
    return count_++;
  }

  std::vector<std::atomic<std::uint8_t>> kind_of_order_;
  std::array<CubeSplit, most_kinds> splits_;
  std::uint8_t count_ = 0;
  std::mutex mutex_;
};

KindTable& table() {
  static KindTable kinds;
  return kinds;
}

}  // namespace

std::uint8_t kind_of_cube(const std::array<std::uint32_t, 8>& ranks) {
  std::array<std::uint8_t, 8> place{};
  std::size_t order = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    std::size_t less_before = 0;
    for (std::size_t j = 0; j < i; ++j) {
      const bool less = ranks[j] < ranks[i];
      less_before += less;
      ++place[less ? i : j];
    }
    order = order * (i + 1) + less_before;
  }
  return table().kind(order, place);
}

const CubeSplit& split_of_kind(std::uint8_t kind) {
  return table().split(kind);
}

}  // namespace ccdt::cores
