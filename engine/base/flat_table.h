#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace ccdt {

/// A hash table in one flat array: open addressing with linear probing, entries move back when one before them goes, so
/// that no tombstones stay. Pointers to values hold until the next insertion or removal.
///
/// `Traits::none()` is a key that never occurs and marks the empty places; `Traits::hash(key)` should fill all bits.
template <class Key, class Value, class Traits>
class FlatTable {
 public:
  struct Entry {
    Key key = Traits::none();
    Value value{};
  };

  std::size_t size() const { return size_; }

  /// Room for so many entries without growing.
  void reserve(std::size_t entries) {
    std::size_t places = least_places;
    while (places < 2 * entries) places *= 2;
    if (places > entries_.size()) grow(places);
  }

  Value* find(const Key& key) {
    if (size_ == 0) return nullptr;
    for (std::size_t i = home(key);; i = next(i)) {
      if (entries_[i].key == key) return &entries_[i].value;
      if (entries_[i].key == Traits::none()) return nullptr;
    }
  }
  const Value* find(const Key& key) const { return const_cast<FlatTable*>(this)->find(key); }

  /// \return the value of the key, and whether it is new
  std::pair<Value*, bool> insert(const Key& key, const Value& value) {
    if (2 * (size_ + 1) > entries_.size()) grow(entries_.empty() ? least_places : 2 * entries_.size());
    std::size_t i = home(key);
    for (; !(entries_[i].key == Traits::none()); i = next(i))
      if (entries_[i].key == key) return {&entries_[i].value, false};
    entries_[i] = {key, value};
    ++size_;
    return {&entries_[i].value, true};
  }

  /// Removes the entry of a value that `find` gave.
  void erase(const Value* value) {
    std::size_t gap = 0;
    for (gap = place_of(value);;) {
      std::size_t i = next(gap);
      // The next entry that may stand in the gap: its home is not between the gap and itself.
      for (; !(entries_[i].key == Traits::none()); i = next(i))
        if (((i - home(entries_[i].key)) & mask()) >= ((i - gap) & mask())) break;
      if (entries_[i].key == Traits::none()) break;
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
      if (!(e.key == Traits::none())) visit(e.key, e.value);
  }

 private:
  static constexpr std::size_t least_places = 16;  // powers of two, at least half of them empty

  std::size_t mask() const { return entries_.size() - 1; }
  std::size_t home(const Key& key) const { return Traits::hash(key) & mask(); }
  std::size_t next(std::size_t i) const { return (i + 1) & mask(); }
  std::size_t place_of(const Value* value) const {
    const auto offset = reinterpret_cast<const char*>(value) - reinterpret_cast<const char*>(&entries_[0].value);
    return static_cast<std::size_t>(offset) / sizeof(Entry);
  }

  void grow(std::size_t places) {
    std::vector<Entry> old(places);
    old.swap(entries_);
    for (const Entry& e : old) {
      if (e.key == Traits::none()) continue;
      std::size_t i = home(e.key);
      while (!(entries_[i].key == Traits::none())) i = next(i);
      entries_[i] = e;
    }
  }

  std::vector<Entry> entries_;
  std::size_t size_ = 0;
};

}  // namespace ccdt
