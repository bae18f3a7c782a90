#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/base/sort_in_runs.h"

namespace ccdt {

/// Sorts items by a small integer of each, their bucket, and then within each bucket, on several threads. That is fast
/// if there are a few items in a bucket.
///
/// \param bucket_of  of an item: the order of the buckets is part of the order of the items
/// \param less       a strict order: no two items are alike, or it does not matter which one comes first
template <class Items, class BucketOf, class Less = std::less<>>
void sort_in_buckets(Items& items, const BucketOf& bucket_of, const Less& less = {}) {
  using Item = typename Items::value_type;
  constexpr std::size_t grain = 4096;
  std::size_t buckets = 0;
  for (const Item& item : items) buckets = std::max<std::size_t>(buckets, std::size_t{bucket_of(item)} + 1);
  if (buckets > 4 * items.size()) return sort_in_runs(items, less);
  std::vector<std::uint32_t> end(buckets + 1, 0);
  const bool alone = thread_count() == 1;
  const auto take_one = [&](std::uint32_t& count) {
    return alone ? count++ : std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  };
  parallel_for(items.size(), grain, [&](std::size_t i) { take_one(end[bucket_of(items[i]) + 1]); });
  for (std::size_t b = 1; b <= buckets; ++b) end[b] += end[b - 1];
  // So far each entry is where the bucket begins. Each item moves it on, to where the bucket ends.
  RawVector<Item> sorted(items.size());
  parallel_for(items.size(), grain, [&](std::size_t i) { sorted[take_one(end[bucket_of(items[i])])] = items[i]; });
  parallel_for(buckets, grain, [&](std::size_t b) {
    const std::uint32_t first = b == 0 ? 0 : end[b - 1];
    std::sort(sorted.begin() + first, sorted.begin() + end[b], less);
    std::copy(sorted.begin() + first, sorted.begin() + end[b], items.begin() + first);
  });
}

}  // namespace ccdt
