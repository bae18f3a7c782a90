#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt {

namespace bucket_sort {

/// How many ranges of buckets the items go to first.
inline constexpr std::size_t range_count = 256;
inline constexpr std::size_t chunk_length = 1 << 15;        ///< of loops on several threads
using Places = std::array<std::uint32_t, range_count + 1>;  ///< where each range begins, and the end

/// One more than the greatest bucket.
template <class Items, class BucketOf>
std::size_t count_buckets(const Items& items, const BucketOf& bucket_of) {
  const auto counts = parallel_chunks(items.size(), chunk_length, [&](std::size_t i, std::size_t end) {
    std::size_t count = 0;
    for (; i < end; ++i) count = std::max(count, std::size_t{bucket_of(items[i])} + 1);
    return count;
  });
  return counts.empty() ? 0 : std::ranges::max(counts);
}

/// \param[out] places  where each chunk of the items begins in each range
template <class Items, class RangeOf>
Places find_places(const Items& items, const RangeOf& range_of, std::vector<Places>& places) {
  places = parallel_chunks(items.size(), chunk_length, [&](std::size_t i, std::size_t end) {
    Places counts{};
    for (; i < end; ++i) ++counts[range_of(items[i])];
    return counts;
  });
  Places first;
  std::uint32_t size = 0;
  for (std::size_t range = 0; range <= range_count; ++range) {
    first[range] = size;
    for (Places& of_chunk : places) size += std::exchange(of_chunk[range], size);
  }
  return first;
}

/// Sorts the items from `first` to `last` into the same places of `sorted`.
///
/// \param bucket_of  of an item, counted from the first one of the range
/// \param end_of     working memory: as many zeros as there are buckets in the range
template <class Item, class BucketOf, class Less, class Items>
void sort_range(const RawVector<Item>& items, std::uint32_t first, std::uint32_t last, const BucketOf& bucket_of,
                const Less& less, std::vector<std::uint32_t>& end_of, Items& sorted) {
  for (std::uint32_t i = first; i < last; ++i) ++end_of[bucket_of(items[i])];
  std::uint32_t begin = first;
  for (std::uint32_t& end : end_of) begin += std::exchange(end, begin);
  // At first, each entry is where its bucket begins. Each item moves it on, finally to where the bucket ends.
  for (std::uint32_t i = first; i < last; ++i) sorted[end_of[bucket_of(items[i])]++] = items[i];
  begin = first;
  for (std::uint32_t& end : end_of) {
    std::sort(sorted.begin() + begin, sorted.begin() + end, less);
    begin = std::exchange(end, 0);
  }
}

}  // namespace bucket_sort

/// Sorts items by a small integer of each, their bucket, and then within each bucket, on several threads. This is fast
/// if each bucket has only a few items.
///
/// First, all items go to ranges of buckets. Each thread counts and places its own items, so that no two write to the
/// same place. Then it sorts whole ranges, which fit into its cache.
///
/// \param bucket_of  of an item: the order of the buckets is part of the order of the items
/// \param less       a strict order; equal items may come in any order
template <class Items, class BucketOf, class Less = std::less<>>
void sort_in_buckets(Items& items, const BucketOf& bucket_of, const Less& less = {}) {
  using namespace bucket_sort;
  using Item = typename Items::value_type;
  const std::size_t buckets = count_buckets(items, bucket_of);
  if (buckets > 4 * items.size()) return sort_in_runs(items, less);

  int shift = 0;
  while (buckets > range_count << shift) ++shift;
  const auto range_of = [&](const Item& item) { return std::size_t{bucket_of(item)} >> shift; };
  std::vector<Places> places;
  const Places first = find_places(items, range_of, places);
  // A single thread would sort a range that has most of the items.
  for (std::size_t range = 0; range < range_count; ++range)
    if (first[range + 1] - first[range] > items.size() / 2) return sort_in_runs(items, less);

  RawVector<Item> in_ranges(items.size());
  parallel_for(places.size(), 1, [&](std::size_t chunk) {
    const std::size_t end = std::min(items.size(), (chunk + 1) * chunk_length);
    for (std::size_t i = chunk * chunk_length; i < end; ++i) in_ranges[places[chunk][range_of(items[i])]++] = items[i];
  });
  parallel_ranges(range_count, 1, [&](std::size_t range, std::size_t end) {
    std::vector<std::uint32_t> end_of(std::size_t{1} << shift, 0);
    for (; range < end; ++range) {
      const auto bucket_here = [&](const Item& item) { return bucket_of(item) - (range << shift); };
      sort_range(in_ranges, first[range], first[range + 1], bucket_here, less, end_of, items);
    }
  });
}

}  // namespace ccdt
