#include "engine/refine/segment_fans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/base/box.h"
#include "engine/base/count_work.h"
#include "engine/base/index_lists.h"
#include "engine/base/union_find.h"

namespace ccdt::refine {
namespace {

/// Squared sine of the angle below which segments are in one fan: 30 degrees.
constexpr double small_angle = 0.25;

/// Unit vectors nearer to each other than the first are surely at a smaller angle, those farther apart than the second
/// at a larger one.
constexpr double surely_small = 0.5176, surely_large = 0.5177;

constexpr std::uint32_t most_spokes_in_leaf = 8;

/// The distance for two segments; 0 if the angle is not small.
double distance_of(const Spoke& s, const Spoke& t) {
  const double squared_sine =
      squared_length(cross(s.along, t.along)) / (squared_length(s.along) * squared_length(t.along));
  if (dot(s.along, t.along) <= 0 || squared_sine >= small_angle) return 0;
  const double step = std::max(s.step, t.step);
  if (!s.grazeable || !t.grazeable) return step;
  return squared_sine > 0 ? step / squared_sine : std::numeric_limits<double>::infinity();
}

class FanSearch {
 public:
  explicit FanSearch(const std::vector<Spoke>& spokes)
      : spokes_(spokes), order_(all_indices(spokes.size())), fans_(spokes.size()), distance_(spokes.size(), 0) {
    for (const Spoke& s : spokes) directions_.push_back((1 / length(s.along)) * s.along);
  }

  std::vector<double> run() {
    if (spokes_.size() > 1) compare_within(add_node(0, static_cast<std::uint32_t>(spokes_.size())));
    std::vector<double> result;
    for (std::uint32_t i = 0; i < spokes_.size(); ++i) result.push_back(distance_[fans_.find(i)]);
    return result;
  }

 private:
  struct Node {
    Box box;  ///< of the directions
    std::uint32_t begin, end;
    std::array<std::uint32_t, 2> children{};  ///< 0: a leaf
    double step = 0, grazeable_step = 0;      ///< the largest step of all segments, and of the grazeable ones
    bool is_one_fan = false;
  };

  std::uint32_t add_node(std::uint32_t begin, std::uint32_t end) {
    Node node{empty_box, begin, end};
    for (std::uint32_t i = begin; i < end; ++i) {
      const Spoke& s = spokes_[order_[i]];
      node.box = hull(node.box, box_of(directions_[order_[i]]));
      node.step = std::max(node.step, s.step);
      if (s.grazeable) node.grazeable_step = std::max(node.grazeable_step, s.step);
    }
    node.is_one_fan = squared_length(node.box.high - node.box.low) < surely_small * surely_small;
    for (std::uint32_t i = begin + 1; node.is_one_fan && i < end; ++i) join(order_[begin], order_[i], 0);
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(node);
    if (end - begin > most_spokes_in_leaf) {
      const std::uint32_t middle = halve(node);
      const std::uint32_t first = add_node(begin, middle), second = add_node(middle, end);
      nodes_[number].children = {first, second};
    }
    return number;
  }

  /// Sorts the directions of a node into two halves along the longest side of its box.
  std::uint32_t halve(const Node& node) {
    const std::array<double, 3> extent = as_array(node.box.high - node.box.low);
    const std::size_t axis = static_cast<std::size_t>(std::ranges::max_element(extent) - extent.begin());
    const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
    std::ranges::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end, {},
                             [&](std::uint32_t i) { return std::pair(as_array(directions_[i])[axis], i); });
    return middle;
  }

  void join(std::uint32_t i, std::uint32_t j, double distance) {
    const double largest = std::max({distance_[fans_.find(i)], distance_[fans_.find(j)], distance});
    distance_[fans_.join(i, j)] = largest;
  }

  void compare(std::uint32_t i, std::uint32_t j) {
    ++work_done.box_pairs;
    const double distance = distance_of(spokes_[i], spokes_[j]);
    if (distance > 0) join(i, j, distance);
  }

  bool is_leaf(const Node& node) const { return node.children[0] == 0; }

  void compare_within(std::uint32_t number) {
    const Node& node = nodes_[number];
    if (!is_leaf(node)) {
      for (const std::uint32_t child : node.children) compare_within(child);
      return compare_between(node.children[0], node.children[1]);
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      for (std::uint32_t j = node.begin; j < i; ++j) compare(order_[i], order_[j]);
  }

  void compare_between(std::uint32_t first, std::uint32_t second) {
    ++work_done.box_tree_nodes;
    const Node &a = nodes_[first], &b = nodes_[second];
    const double gap = std::sqrt(squared_distance(a.box, b.box));
    if (gap > surely_large) return;
    if (a.is_one_fan && b.is_one_fan) {
      const std::uint32_t fan = fans_.find(order_[a.begin]);
      if (fans_.find(order_[b.begin]) == fan && distance_[fan] >= largest_distance(a, b, gap)) return;
    }
    if (is_leaf(a) && is_leaf(b)) {
      for (std::uint32_t i = a.begin; i < a.end; ++i)
        for (std::uint32_t j = b.begin; j < b.end; ++j) compare(order_[i], order_[j]);
    } else if (is_leaf(b) || (!is_leaf(a) && a.end - a.begin >= b.end - b.begin)) {
      for (const std::uint32_t child : a.children) compare_between(child, second);
    } else {
      for (const std::uint32_t child : b.children) compare_between(first, child);
    }
  }

  /// No two segments of two nodes can have a larger distance.
  double largest_distance(const Node& a, const Node& b, double gap) const {
    constexpr double rounding = 1e-14;
    const double step = std::max(a.step, b.step);
    if (a.grazeable_step == 0 || b.grazeable_step == 0) return step;
    const double least = std::max(0.0, gap - rounding), squared_sine = least * least * (1 - 0.25 * least * least);
    return std::max(step, (1 + 1e-9) * std::max(a.grazeable_step, b.grazeable_step) / squared_sine);
  }

  const std::vector<Spoke>& spokes_;
  std::vector<Point3> directions_;    // unit vectors
  std::vector<std::uint32_t> order_;  // the directions of a node are consecutive
  std::vector<Node> nodes_;
  UnionFind fans_;
  std::vector<double> distance_;  // of the fan that this one stands for
};

}  // namespace

std::vector<double> find_fan_distances(const std::vector<Spoke>& spokes) {
  return FanSearch(spokes).run();
}

}  // namespace ccdt::refine
