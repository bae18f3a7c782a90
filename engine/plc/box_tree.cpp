#include "engine/plc/box_tree.h"

#include <limits>

namespace ccdt {

namespace {

constexpr int bits_per_axis = 21;

// Spreads the lowest 21 bits so that two empty bits follow each.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFFu;
  v = (v | v << 16) & 0x001F0000FF0000FFu;
  v = (v | v << 8) & 0x100F00F00F00F00Fu;
  v = (v | v << 4) & 0x10C30C30C30C30C3u;
  return (v | v << 2) & 0x1249249249249249u;
}

constexpr ClosedBox empty_box() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {{inf, inf, inf}, {-inf, -inf, -inf}};
}

// Twice the centre; finite boxes of the grid do not overflow.
Point3 doubled_centre(const ClosedBox& b) {
  return b.low + b.high;
}

std::vector<std::uint32_t> morton_order(const std::vector<ClosedBox>& boxes) {
  ClosedBox centres = empty_box();
  for (const ClosedBox& b : boxes) centres = hull(centres, box_of(doubled_centre(b)));
  const Point3 size = centres.high - centres.low;
  const double extent = std::max({size.x, size.y, size.z, 1.0});
  const double scale = ((1 << bits_per_axis) - 1) / extent;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Point3 p = scale * (doubled_centre(boxes[i]) - centres.low);
    keyed[i] = {spread(static_cast<std::uint64_t>(p.x)) | spread(static_cast<std::uint64_t>(p.y)) << 1 |
                    spread(static_cast<std::uint64_t>(p.z)) << 2,
                i};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) order[i] = keyed[i].second;
  return order;
}

}  // namespace

BoxTree::BoxTree(std::vector<ClosedBox> boxes) : boxes_(std::move(boxes)), items_(morton_order(boxes_)) {
  while (std::size_t{leaf_count_} * leaf_size < items_.size()) leaf_count_ *= 2;
  nodes_.assign(std::size_t{leaf_count_} * 2, empty_box());
  for (std::uint32_t leaf = leaf_count_; leaf < 2 * leaf_count_; ++leaf)
    for (const std::uint32_t i : items_of(leaf)) nodes_[leaf] = hull(nodes_[leaf], boxes_[i]);
  for (std::uint32_t node = leaf_count_ - 1; node >= 1; --node)
    nodes_[node] = hull(nodes_[2 * node], nodes_[2 * node + 1]);
}

}  // namespace ccdt
