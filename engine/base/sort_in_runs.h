#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <vector>

#include "engine/base/parallel.h"

namespace ccdt {

/// Sorts runs of the items on one thread each, and merges them.
///
/// \param sort_run  called with two iterators
/// \param less      a strict order: no two items are alike, or it does not matter which one comes first
template <class Item, class SortRun, class Less>
void sort_in_runs(std::vector<Item>& items, const SortRun& sort_run, const Less& less) {
  constexpr std::size_t least_run = 20000;
  const std::size_t runs = std::bit_floor(std::clamp<std::size_t>(items.size() / least_run, 1, thread_count()));
  const auto place = [&](std::size_t run) {
    return items.begin() + static_cast<std::ptrdiff_t>(items.size() * run / runs);
  };
  parallel_for(runs, 1, [&](std::size_t r) { sort_run(place(r), place(r + 1)); });
  for (std::size_t merged = 1; merged < runs; merged *= 2)
    parallel_for(runs / (2 * merged), 1, [&](std::size_t i) {
      const std::size_t r = 2 * merged * i;
      std::inplace_merge(place(r), place(r + merged), place(r + 2 * merged), less);
    });
}

/// The same by comparisons alone.
template <class Item, class Less = std::less<>>
void sort_in_runs(std::vector<Item>& items, const Less& less = {}) {
  sort_in_runs(
      items, [&](auto begin, auto end) { std::sort(begin, end, less); }, less);
}

}  // namespace ccdt
