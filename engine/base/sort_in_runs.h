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
/// \param less      a strict order; equal items may come in any order
template <class Items, class SortRun, class Less>
void sort_in_runs(Items& items, const SortRun& sort_run, const Less& less) {
  constexpr std::size_t least_run = 4096;
  using Iterator = typename Items::iterator;
  const std::size_t runs = std::bit_floor(std::clamp<std::size_t>(items.size() / least_run, 1, thread_count()));
  const auto place = [&](std::size_t run) {
    return items.begin() + static_cast<std::ptrdiff_t>(items.size() * run / runs);
  };
  parallel_for(runs, 1, [&](std::size_t r) { sort_run(place(r), place(r + 1)); });
  struct Halves {
    Iterator begin, left, middle, right, end;
  };
  for (std::size_t merged = 1; merged < runs; merged *= 2) {
    const std::size_t pairs = runs / (2 * merged);
    std::vector<Halves> halves(pairs);
    // What belongs before the middle of the first run is merged by one thread, and the rest by another.
    parallel_for(pairs, 1, [&](std::size_t i) {
      const Iterator begin = place(2 * merged * i), next = place(2 * merged * i + merged);
      const Iterator end = place(2 * merged * (i + 1)), left = begin + (next - begin) / 2;
      const Iterator right = std::lower_bound(next, end, *left, less);
      halves[i] = {begin, left, std::rotate(left, next, right), right, end};
    });
    parallel_for(2 * pairs, 1, [&](std::size_t i) {
      const auto& [begin, left, middle, right, end] = halves[i / 2];
      i % 2 == 0 ? std::inplace_merge(begin, left, middle, less) : std::inplace_merge(middle, right, end, less);
    });
  }
}

/// The same by comparisons alone.
template <class Items, class Less = std::less<>>
void sort_in_runs(Items& items, const Less& less = {}) {
  sort_in_runs(
      items, [&](auto begin, auto end) { std::sort(begin, end, less); }, less);
}

}  // namespace ccdt
