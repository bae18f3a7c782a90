#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt {

/// Sorts items by a small integer of each, their bucket, and then within each bucket, on several threads. That is fast
/// if there are a few items in a bucket.
///
/// All items go to 256 ranges of buckets first. Each thread counts and places its own, so that no two write to the same
/// place, and then sorts whole ranges, which fit into its cache.
///
/// \param bucket_of  of an item: the order of the buckets is part of the order of the items
/// \param less       a strict order: no two items are alike, or it does not matter which one comes first
template <class Items, class BucketOf, class Less = std::less<>>
void sort_in_buckets(Items& items, const BucketOf& bucket_of, const Less& less = {}) {
  constexpr std::size_t ranges = 256, chunk_length = 1 << 15;
  using Places = std::array<std::uint32_t, ranges>;
  const auto chunks = [&](const auto& work) { return parallel_chunks(items.size(), chunk_length, work); };
  std::size_t buckets = 0;
  for (const std::size_t most : chunks([&](std::size_t i, std::size_t end) {
         std::size_t most_here = 0;
         for (; i < end; ++i) most_here = std::max<std::size_t>(most_here, std::size_t{bucket_of(items[i])} + 1);
         return most_here;
       }))
    buckets = std::max(buckets, most);
  if (buckets > 4 * items.size()) return sort_in_runs(items, less);

  const int shift =
      std::max(0, static_cast<int>(std::bit_width(buckets)) - static_cast<int>(std::bit_width(ranges - 1)));
  const auto range_of = [&](std::size_t i) { return std::size_t{bucket_of(items[i])} >> shift; };
  std::vector<Places> places = chunks([&](std::size_t i, std::size_t end) {
    Places counts{};
    for (; i < end; ++i) ++counts[range_of(i)];
    return counts;
  });
  std::array<std::uint32_t, ranges + 1> first{};
  for (std::size_t range = 0, size = 0; range < ranges; ++range) {
    first[range] = static_cast<std::uint32_t>(size);
    for (Places& of_chunk : places) size += std::exchange(of_chunk[range], static_cast<std::uint32_t>(size));
    first[range + 1] = static_cast<std::uint32_t>(size);
  }
  RawVector<typename Items::value_type> in_ranges(items.size());
  parallel_for(places.size(), 1, [&](std::size_t chunk) {
    const std::size_t end = std::min(items.size(), (chunk + 1) * chunk_length);
    for (std::size_t i = chunk * chunk_length; i < end; ++i) in_ranges[places[chunk][range_of(i)]++] = items[i];
  });

  parallel_ranges(ranges, 1, [&](std::size_t range, std::size_t last_range) {
    std::vector<std::uint32_t> ends(std::size_t{1} << shift);
    for (; range < last_range; ++range) {
      const auto bucket_here = [&](std::size_t i) { return bucket_of(in_ranges[i]) - (range << shift); };
      std::ranges::fill(ends, 0);
      for (std::size_t i = first[range]; i < first[range + 1]; ++i) ++ends[bucket_here(i)];
      std::uint32_t begin = first[range];
      for (std::uint32_t& end : ends) begin += std::exchange(end, begin);
      // So far each entry is where the bucket begins. Each item moves it on, to where the bucket ends.
      for (std::size_t i = first[range]; i < first[range + 1]; ++i) items[ends[bucket_here(i)]++] = in_ranges[i];
      begin = first[range];
      for (const std::uint32_t end : ends) {
        std::sort(items.begin() + begin, items.begin() + end, less);
        begin = end;
      }
    }
  });
}

}  // namespace ccdt
