#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::io {

/// Gives equal points one index: a hash table with open addressing over a list of points. Formats that repeat a vertex
/// for every triangle would need six times the memory otherwise. 0 and -0 are equal.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Point3>& vertices) : vertices_(vertices), slots_(1024, free_slot) {}

  /// The index of the point in the list, which it joins if it is new.
  std::uint32_t index_of(Point3 point) {
    point = {point.x + 0.0, point.y + 0.0, point.z + 0.0};  // -0 becomes 0
    if (2 * vertices_.size() >= slots_.size()) grow();
    std::uint32_t& entry = slots_[slot_of(point)];
    if (entry == free_slot) {
      entry = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(point);
    }
    return entry;
  }

 private:
  static constexpr std::uint32_t free_slot = 0xFFFFFFFFu;

  static std::uint64_t mixed(std::uint64_t h) {  // the finalizer of MurmurHash3
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
    return h ^ (h >> 33);
  }
  std::size_t slot_of(const Point3& point) const {
    std::uint64_t hash = 0;
    for (const double coordinate : as_array(point)) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(coordinate));
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash & mask;
    while (slots_[slot] != free_slot && vertices_[slots_[slot]] != point) slot = (slot + 1) & mask;
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), free_slot);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) slots_[slot_of(vertices_[i])] = i;
  }

  std::vector<Point3>& vertices_;
  std::vector<std::uint32_t> slots_;  ///< a power of two in number, at most half of them used
};

}  // namespace ccdt::io
