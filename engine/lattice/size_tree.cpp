#include "engine/lattice/size_tree.h"

#include <algorithm>

namespace ccdt {

SizeTree::SizeTree(std::vector<Item> items) : items_(std::move(items)) {
  if (items_.empty()) return;
  constexpr std::size_t items_a_leaf = 8;
  std::size_t leaves = 1;
  while (leaves * items_a_leaf < items_.size()) leaves *= 2;
  first_leaf_ = leaves - 1;
  groups_.resize(2 * leaves - 1);
  sort(0, items_.size(), 0);
}

void SizeTree::sort(std::size_t begin, std::size_t end, std::size_t group) {
  Group all{items_[begin].box, items_[begin].size};
  for (std::size_t i = begin; i < end; ++i) {
    const Box& box = items_[i].box;
    all = {bounding_box(std::array{all.box.low, all.box.high, box.low, box.high}), std::min(all.size, items_[i].size)};
  }
  groups_[group] = all;
  if (group >= first_leaf_) return;
  const auto extent = as_array(all.box.high - all.box.low);
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
  const std::size_t half = middle(begin, end);
  const auto at = [this](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(half), at(end), [axis](const Item& a, const Item& b) {
    return as_array(a.box.low + a.box.high)[axis] < as_array(b.box.low + b.box.high)[axis];
  });
  sort(begin, half, 2 * group + 1);
  sort(half, end, 2 * group + 2);
}

}  // namespace ccdt
