#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ccdt {

/// A small open hash table from vertices or edges of one facet to a position in its arrays.
///
/// A facet knows only a few of the vertices of the whole complex, so it cannot afford an array over all ids. Entries
/// are never removed (they can be set to `none`) and never enumerated, so nothing depends on the order inside the
/// table.
class PlanarMap {
 public:
  using Key = std::uint64_t;
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  /// The value of a key, or `none`.
  std::uint32_t get(Key key) const {
    if (slots_.empty()) return none;
    return slots_[slot_of(key)].value;
  }

  void set(Key key, std::uint32_t value) {
    if (2 * (used_ + 1) > slots_.size()) grow(slots_.empty() ? smallest : 2 * slots_.size());
    Slot& slot = slots_[slot_of(key)];
    if (slot.key == free_key) {
      slot.key = key;
      ++used_;
    }
    slot.value = value;
  }

  /// Makes room for `count` keys in all.
  void reserve(std::size_t count) {
    std::size_t size = smallest;
    while (size < 2 * count) size *= 2;
    if (size > slots_.size()) grow(size);
  }

  void clear() {
    slots_.clear();
    used_ = 0;
  }

 private:
  struct Slot {
    Key key = free_key;
    std::uint32_t value = none;
  };
  static constexpr Key free_key = ~Key{0};
  static constexpr std::size_t smallest = 8;

  std::size_t slot_of(Key key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> 29) & mask;
    while (slots_[i].key != key && slots_[i].key != free_key) i = (i + 1) & mask;
    return i;
  }

  void grow(std::size_t size) {
    std::vector<Slot> old(size);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.key != free_key) slots_[slot_of(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two, at most half full
  std::size_t used_ = 0;
};

}  // namespace ccdt
