#include "engine/base/box_tree.h"

#include "engine/base/morton.h"

namespace ccdt {

namespace {

std::vector<std::uint32_t> order_of(const std::vector<Box>& boxes) {
  std::vector<Point3> centers(boxes.size());
  // Twice the centers; finite boxes of the grid do not overflow.
  std::ranges::transform(boxes, centers.begin(), [](const Box& b) { return b.low + b.high; });
  return morton_order(centers);
}

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : items_(order_of(boxes)) {
  boxes_.resize(boxes.size());
  std::ranges::transform(items_, boxes_.begin(), [&](std::uint32_t i) { return boxes[i]; });
  while (std::size_t{leaf_count_} * leaf_size < items_.size()) leaf_count_ *= 2;
  nodes_.assign(std::size_t{leaf_count_} * 2, empty_box);
  for (std::uint32_t leaf = leaf_count_; leaf < 2 * leaf_count_; ++leaf)
    for (auto [i, end] = places_of(leaf); i < end; ++i) nodes_[leaf] = hull(nodes_[leaf], boxes_[i]);
  for (std::uint32_t node = leaf_count_ - 1; node >= 1; --node)
    nodes_[node] = hull(nodes_[2 * node], nodes_[2 * node + 1]);
}

}  // namespace ccdt
