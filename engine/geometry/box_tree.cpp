#include "engine/geometry/box_tree.h"

#include <algorithm>

#include "engine/base/morton.h"

namespace ccdt {

namespace {

constexpr std::size_t boxes_per_batch = 4096;  ///< of loops on several threads

std::vector<std::uint32_t> order_of(const RawVector<Box>& boxes) {
  // Twice the centers; finite boxes of the grid do not overflow.
  RawVector<Point3> centers(boxes.size());
  parallel_for(boxes.size(), boxes_per_batch, [&](std::size_t i) { centers[i] = boxes[i].low + boxes[i].high; });
  return morton_order(centers);
}

}  // namespace

BoxTree::BoxTree(RawVector<Box> boxes, const RawVector<double>& sizes) : items_(order_of(boxes)) {
  boxes_.resize(boxes.size()), sizes_.resize(sizes.size());
  parallel_for(boxes.size(), boxes_per_batch, [&](std::size_t i) { boxes_[i] = boxes[items_[i]]; });
  parallel_for(sizes.size(), boxes_per_batch, [&](std::size_t i) { sizes_[i] = sizes[items_[i]]; });
  while (std::size_t{leaf_count_} * leaf_size < items_.size()) leaf_count_ *= 2;
  nodes_.resize(std::size_t{leaf_count_} * 2);
  parallel_for(leaf_count_, boxes_per_batch, [&](std::size_t i) {
    const auto leaf = static_cast<std::uint32_t>(leaf_count_ + i);
    Box& all = nodes_[leaf] = empty_box;
    for (auto [place, end] = places_of(leaf); place < end; ++place) all = hull(all, boxes_[place]);
  });
  for (std::size_t level = leaf_count_ / 2; level >= 1; level /= 2)
    parallel_for(level, boxes_per_batch, [&](std::size_t i) {
      const std::size_t node = level + i;
      nodes_[node] = hull(nodes_[2 * node], nodes_[2 * node + 1]);
    });
  if (sizes_.empty()) return;
  least_sizes_.resize(nodes_.size());
  for (std::size_t node = nodes_.size(); node-- > 1;) {
    double& least = least_sizes_[node] = HUGE_VAL;
    if (!is_leaf(static_cast<std::uint32_t>(node))) {
      least = std::min(least_sizes_[2 * node], least_sizes_[2 * node + 1]);
      continue;
    }
    for (auto [place, end] = places_of(static_cast<std::uint32_t>(node)); place < end; ++place)
      least = std::min(least, sizes_[place]);
  }
}

void BoxTree::enlarge(std::uint32_t item, const Box& box) {
  if (places_.empty()) {
    places_.resize(items_.size());
    for (std::uint32_t place = 0; place < items_.size(); ++place) places_[items_[place]] = place;
  }
  const std::uint32_t place = places_[item];
  boxes_[place] = hull(boxes_[place], box);
  for (std::uint32_t node = leaf_count_ + place / leaf_size; node >= 1; node /= 2)
    nodes_[node] = hull(nodes_[node], box);
}

}  // namespace ccdt
