#include "engine/base/morton.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_in_buckets.h"

namespace ccdt {

namespace {

bool less(const KeyedIndex& a, const KeyedIndex& b) {
  return a.key != b.key ? a.key < b.key : a.index < b.index;
}

/// How many bits the keys have.
int bits_of_keys(const RawVector<KeyedIndex>& items) {
  std::uint64_t all = 0;
  for (const std::uint64_t some : parallel_chunks(items.size(), 1 << 16, [&](std::size_t i, std::size_t end) {
         std::uint64_t bits = 0;
         for (; i < end; ++i) bits |= items[i].key;
         return bits;
       }))
    all |= some;
  return std::bit_width(all);
}

}  // namespace

std::vector<std::uint32_t> sorted_by_key(RawVector<KeyedIndex> items) {
  // At least as many buckets as items.
  const int bits = std::bit_width(items.size());
  const int shift = std::max(0, bits_of_keys(items) - bits);
  sort_in_buckets(
      items, [&](const KeyedIndex& item) { return static_cast<std::uint32_t>(item.key >> shift); }, less);
  std::vector<std::uint32_t> order(items.size());
  parallel_for(items.size(), 4096, [&](std::size_t i) { order[i] = items[i].index; });
  return order;
}

std::vector<std::uint32_t> morton_order(std::span<const Point3> points) {
  const Box box = bounding_box(points);
  const Point3 size = box.high - box.low;
  const double extent = std::max({size.x, size.y, size.z, 1.0});
  constexpr int bits_per_axis = 21;
  const double scale = ((1 << bits_per_axis) - 1) / extent;
  RawVector<KeyedIndex> keyed(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    keyed[i] = {morton_code_at(scale * (points[i] - box.low)), static_cast<std::uint32_t>(i)};
  });
  return sorted_by_key(std::move(keyed));
}

}  // namespace ccdt
