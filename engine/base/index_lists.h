#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "engine/base/parallel.h"

namespace ccdt {

/// The indices 0, 1, ..., count - 1.
inline std::vector<std::uint32_t> all_indices(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

/// Lists of indices in two flat arrays: list i is items[first[i] .. first[i + 1]).
struct IndexLists {
  std::vector<std::uint32_t> first, items;

  std::span<const std::uint32_t> of(std::size_t list) const {
    return {items.data() + first[list], items.data() + first[list + 1]};
  }
};

/// Builds lists from `visit_pairs(emit)`, which calls emit(list, item) for each pair. It is called twice and must emit
/// the same pairs in the same order.
///
/// \param count  how many lists; each `list` is below it
template <class VisitPairs>
IndexLists make_index_lists(std::size_t count, const VisitPairs& visit_pairs) {
  IndexLists lists;
  lists.first.assign(count + 1, 0);
  visit_pairs([&](std::size_t list, std::uint32_t) { ++lists.first[list + 1]; });
  for (std::size_t i = 0; i < count; ++i) lists.first[i + 1] += lists.first[i];
  lists.items.resize(lists.first[count]);
  std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
  visit_pairs([&](std::size_t list, std::uint32_t item) { lists.items[next[list]++] = item; });
  return lists;
}

/// The same where each item is in one list: distributes the items 0, 1, ..., item_count - 1, on all threads.
///
/// \param list_of  of an item; called twice for each
template <class ListOf>
IndexLists group_indices(std::size_t count, std::size_t item_count, const ListOf& list_of) {
  if (thread_count() == 1)
    return make_index_lists(count, [&](const auto& emit) {
      for (std::uint32_t i = 0; i < item_count; ++i) emit(list_of(i), i);
    });
  constexpr std::size_t grain = 4096;
  const AddOne add_one;
  IndexLists lists;
  lists.first.assign(count + 1, 0);
  lists.items.resize(item_count);
  parallel_for(item_count, grain, [&](std::size_t i) { add_one(lists.first[list_of(i) + 1]); });
  for (std::size_t i = 0; i < count; ++i) lists.first[i + 1] += lists.first[i];
  std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
  parallel_for(item_count, grain,
               [&](std::size_t i) { lists.items[add_one(next[list_of(i)])] = static_cast<std::uint32_t>(i); });
  parallel_for(count, grain, [&](std::size_t list) {
    std::sort(lists.items.begin() + lists.first[list], lists.items.begin() + lists.first[list + 1]);
  });
  return lists;
}

}  // namespace ccdt
