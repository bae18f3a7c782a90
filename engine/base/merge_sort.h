#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace ccdt {

/// Sorts a list stably, with the same comparisons for every standard library. Use it if comparisons count as work
/// (base/work.h), such as exact predicates.
///
/// \param less  a strict weak order
template <class Item, class Less>
void merge_sort(std::vector<Item>& items, const Less& less) {
  std::vector<Item> merged(items.size());
  for (std::size_t run = 1; run < items.size(); run *= 2) {
    for (std::size_t begin = 0; begin < items.size(); begin += 2 * run) {
      const std::size_t middle = std::min(begin + run, items.size()), end = std::min(begin + 2 * run, items.size());
      std::size_t left = begin, right = middle;
      for (std::size_t to = begin; to < end; ++to) {
        const bool from_left = right == end || (left < middle && !less(items[right], items[left]));
        merged[to] = items[from_left ? left++ : right++];
      }
    }
    items.swap(merged);
  }
}

}  // namespace ccdt
