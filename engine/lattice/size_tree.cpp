#include "engine/lattice/size_tree.h"

#include <algorithm>

#include "engine/base/morton.h"

namespace ccdt {

SizeTree::SizeTree(const std::vector<Item>& items) {
  if (items.empty()) return;
  std::vector<Point3> centres(items.size());
  std::ranges::transform(items, centres.begin(), [](const Item& item) { return item.box.low + item.box.high; });
  items_.reserve(items.size());
  for (const std::uint32_t i : morton_order(centres)) items_.push_back(items[i]);
  constexpr std::size_t items_a_leaf = 8;
  std::size_t leaves = 1;
  while (leaves * items_a_leaf < items_.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  groups_.resize(2 * leaves - 1);
  surround(0, items_.size(), 0);
}

SizeTree::Group SizeTree::surround(std::size_t begin, std::size_t end, std::size_t group) {
  const auto both = [](const Group& a, const Box& box, double size) {
    return Group{bounding_box(std::array{a.box.low, a.box.high, box.low, box.high}), std::min(a.size, size)};
  };
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

}  // namespace ccdt
