#include "engine/plc/box_tree.h"

#include <limits>

#include "engine/numbers/morton.h"

namespace ccdt {

namespace {

constexpr ClosedBox empty_box() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {{inf, inf, inf}, {-inf, -inf, -inf}};
}

// Twice the centre; finite boxes of the grid do not overflow.
Point3 doubled_centre(const ClosedBox& b) {
  return b.low + b.high;
}

std::vector<std::uint32_t> order_of(const std::vector<ClosedBox>& boxes) {
  std::vector<Point3> centres(boxes.size());
  std::ranges::transform(boxes, centres.begin(), doubled_centre);
  return morton_order(centres);
}

}  // namespace

BoxTree::BoxTree(std::vector<ClosedBox> boxes) : items_(order_of(boxes)) {
  boxes_.resize(boxes.size());
  std::ranges::transform(items_, boxes_.begin(), [&](std::uint32_t i) { return boxes[i]; });
  while (std::size_t{leaf_count_} * leaf_size < items_.size()) leaf_count_ *= 2;
  nodes_.assign(std::size_t{leaf_count_} * 2, empty_box());
  for (std::uint32_t leaf = leaf_count_; leaf < 2 * leaf_count_; ++leaf)
    for (auto [i, end] = places_of(leaf); i < end; ++i) nodes_[leaf] = hull(nodes_[leaf], boxes_[i]);
  for (std::uint32_t node = leaf_count_ - 1; node >= 1; --node)
    nodes_[node] = hull(nodes_[2 * node], nodes_[2 * node + 1]);
}

}  // namespace ccdt
