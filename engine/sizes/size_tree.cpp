#include "engine/sizes/size_tree.h"

#include <algorithm>
#include <vector>

#include "engine/base/morton.h"
#include "engine/base/parallel.h"

namespace ccdt::sizes {

SizeTree::SizeTree(std::span<const SizedPlace> items) {
  if (items.empty()) return;
  RawVector<Point3> centers(items.size());
  parallel_for(items.size(), 4096, [&](std::size_t i) { centers[i] = items[i].box.low + items[i].box.high; });
  const std::vector<std::uint32_t> order = morton_order(centers);
  items_.resize(items.size());
  parallel_for(items.size(), 4096, [&](std::size_t i) { items_[i] = items[order[i]]; });
  constexpr std::size_t items_a_leaf = 8;
  std::size_t leaves = 1;
  while (leaves * items_a_leaf < items_.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  groups_.resize(2 * leaves - 1);
  // Groups that are large enough for several threads, and whatever is above them.
  struct Part {
    std::size_t begin, end;
  };
  std::vector<Part> parts = {{0, items_.size()}};
  while (parts.size() < std::min(leaves, std::size_t{64})) {
    std::vector<Part> halves;
    for (const auto& [begin, end] : parts) {
      halves.push_back({begin, middle(begin, end)});
      halves.push_back({middle(begin, end), end});
    }
    parts = std::move(halves);
  }
  const std::size_t above = parts.size() - 1;
  parallel_for(parts.size(), 1, [&](std::size_t i) { surround(parts[i].begin, parts[i].end, above + i); });
  for (std::size_t group = above; group-- > 0;) {
    const Group& right = groups_[2 * group + 2];
    groups_[group] = both(groups_[2 * group + 1], right.box, right.size);
  }
}

SizeTree::Group SizeTree::both(const Group& a, const Box& box, double size) {
  return {bounding_box(std::array{a.box.low, a.box.high, box.low, box.high}), std::min(a.size, size)};
}

SizeTree::Group SizeTree::surround(std::size_t begin, std::size_t end, std::size_t group) {
  Group& all = groups_[group];
  if (group >= first_leaf_) {
    all = {items_[begin].box, items_[begin].size};
    for (std::size_t i = begin + 1; i < end; ++i) all = both(all, items_[i].box, items_[i].size);
  } else {
    const std::size_t half = middle(begin, end);
    const Group right = surround(half, end, 2 * group + 2);
    all = both(surround(begin, half, 2 * group + 1), right.box, right.size);
  }
  return all;
}

}  // namespace ccdt::sizes
