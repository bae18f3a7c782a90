#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/platform.h"

namespace ccdt {

/// The properties of keys that a `HashTable` needs: `none()` is a key that never occurs and marks the empty places;
/// `hash(key)` should fill all bits, since tables use the lowest.
template <class Key>
struct HashTraits;

/// Indices of any kind.
template <>
struct HashTraits<std::uint32_t> {
  static constexpr std::uint32_t none() { return ccdt::none; }
  static std::size_t hash(std::uint32_t key) {
    const std::uint64_t h = key * std::uint64_t{0x9E3779B97F4A7C15};
    return static_cast<std::size_t>(h ^ h >> 32);
  }
};
template <class Tag>
struct HashTraits<Index<Tag>> {
  static constexpr Index<Tag> none() { return {}; }
  static std::size_t hash(Index<Tag> key) { return HashTraits<std::uint32_t>::hash(key.value); }
};

/// Edges, by `edge_key`, and other 64-bit numbers.
template <>
struct HashTraits<std::uint64_t> {
  static constexpr std::uint64_t none() { return ~std::uint64_t{0}; }
  static std::size_t hash(std::uint64_t key) { return (key ^ key >> 31) * 0x9E3779B97F4A7C15u >> 20; }
};

/// Faces, by `face_key`, points and other short lists of integers. The greatest integers never occur together.
template <class Integer, std::size_t N>
struct HashTraits<std::array<Integer, N>> {
  static constexpr std::array<Integer, N> none() {
    std::array<Integer, N> key{};
    key.fill(std::numeric_limits<Integer>::max());
    return key;
  }
  static std::size_t hash(const std::array<Integer, N>& key) {
    std::uint64_t h = 0;
    for (const Integer x : key) {  // numbers often end in zeros, so the high bits must be mixed into the low ones
      h = (h ^ static_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

template <class Key>
constexpr bool is_same_key(const Key& a, const Key& b) {
  return a == b;
}
/// Without a call of memcmp.
template <class Integer, std::size_t N>
constexpr bool is_same_key(const std::array<Integer, N>& a, const std::array<Integer, N>& b) {
  Integer difference = 0;
  for (std::size_t i = 0; i < N; ++i) difference |= a[i] ^ b[i];
  return difference == 0;
}

/// A hash table in one flat array: open addressing with linear probing. Entries move back when an earlier one is
/// removed, so there are no tombstones. Pointers to values are valid until the next insertion or removal.
template <class Key, class Value, class Traits = HashTraits<Key>>
class HashTable {
 public:
  struct Entry {
    Key key = Traits::none();
    [[no_unique_address]] Value value{};
  };

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Of all places, including empty ones.
  std::size_t bytes() const { return entries_.size() * sizeof(Entry); }
  void clear() { *this = {}; }

  /// Reserves room for this many entries.
  void reserve(std::size_t entries) {
    std::size_t places = least_places;
    while (places < 2 * entries) places *= 2;
    if (places > entries_.size()) grow(places);
  }

  /// Fetches into the cache the place of a key that will be looked up soon.
  void prefetch(const Key& key) const {
    if (!entries_.empty()) ccdt::prefetch(&entries_[home(key)]);
  }

  Value* find(const Key& key) {
    if (size_ == 0) return nullptr;
    for (std::size_t i = home(key);; i = next(i)) {
      if (is_same_key(entries_[i].key, key)) return &entries_[i].value;
      if (is_empty(i)) return nullptr;
    }
  }
  const Value* find(const Key& key) const { return const_cast<HashTable*>(this)->find(key); }

  bool contains(const Key& key) const { return find(key) != nullptr; }
  /// A copy of the value of the key, or `otherwise` if there is none.
  Value get(const Key& key, const Value& otherwise) const {
    const Value* value = find(key);
    return value != nullptr ? *value : otherwise;
  }

  /// Adds the entry unless the key has one.
  ///
  /// \return  the value of the key, and whether it is new
  std::pair<Value*, bool> insert(const Key& key, const Value& value = {}) {
    if (2 * (size_ + 1) > entries_.size()) grow(entries_.empty() ? least_places : 2 * entries_.size());
    std::size_t i = home(key);
    for (; !is_empty(i); i = next(i))
      if (is_same_key(entries_[i].key, key)) return {&entries_[i].value, false};
    entries_[i] = {key, value};
    ++size_;
    return {&entries_[i].value, true};
  }

  /// Adds the entry, or changes the value of the existing one.
  void set(const Key& key, const Value& value) { *insert(key, value).first = value; }

  /// Removes the entry of a value that `find` gave.
  void erase(const Value* value) {
    std::size_t gap = 0;
    for (gap = place_of(value);;) {
      std::size_t i = next(gap);
      // Finds the next entry that may move to the gap: its home is not between the gap and its place.
      for (; !is_empty(i); i = next(i))
        if (((i - home(entries_[i].key)) & mask()) >= ((i - gap) & mask())) break;
      if (is_empty(i)) break;
      entries_[gap] = entries_[i];
      gap = i;
    }
    entries_[gap].key = Traits::none();
    --size_;
  }

  /// Calls visit(key, value) for all entries, in the order of their places.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& e : entries_)
      if (!is_same_key(e.key, Traits::none())) visit(e.key, e.value);
  }

 private:
  static constexpr std::size_t least_places = 16;  // powers of two, at least half of them empty

  std::size_t mask() const { return entries_.size() - 1; }
  std::size_t home(const Key& key) const { return Traits::hash(key) & mask(); }
  std::size_t next(std::size_t i) const { return (i + 1) & mask(); }
  bool is_empty(std::size_t i) const { return is_same_key(entries_[i].key, Traits::none()); }
  std::size_t place_of(const Value* value) const {
    const auto offset = reinterpret_cast<const char*>(value) - reinterpret_cast<const char*>(&entries_[0].value);
    return static_cast<std::size_t>(offset) / sizeof(Entry);
  }

  void grow(std::size_t places) {
    std::vector<Entry> old(places);
    old.swap(entries_);
    for (const Entry& e : old) {
      if (is_same_key(e.key, Traits::none())) continue;
      std::size_t i = home(e.key);
      while (!is_empty(i)) i = next(i);
      entries_[i] = e;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

struct NoValue {};
template <class Key, class Traits = HashTraits<Key>>
using HashSet = HashTable<Key, NoValue, Traits>;

}  // namespace ccdt
