#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/box.h"
#include "engine/base/count_work.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace ccdt {

/// A hierarchy of bounding boxes: the items in Morton order of their centers, halved repeatedly.
///
///     node 1 = [2 3], node i = [2i 2i+1], the last `leaf_count` nodes are runs of `leaf_size` items
class BoxTree {
 public:
  explicit BoxTree(RawVector<Box> boxes);

  std::size_t bytes() const { return bytes_of(items_, boxes_, nodes_); }

  /// Calls visit(item) for all items whose box meets the given box or line segment.
  template <class Shape, class Visit>
  void for_each_meeting(const Shape& shape, Visit&& visit) const {
    if (!items_.empty() && nodes_[1].meets(shape)) descend(1, shape, visit);
  }

  /// Calls visit(i, j) once for every pair of different items whose boxes meet.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    if (!items_.empty()) descend_self(1, AllPairs{*this}, visit);
  }

  /// Calls collect(found, i, j), on several threads, for the pairs of which at least one item is wanted, to add to a
  /// list.
  ///
  /// \param is_wanted  by item; empty: all are
  /// \return  the lists, one after the other as `for_each_pair` comes to their pairs
  template <class Item, class Collect>
  std::vector<Item> collect_from_pairs(std::span<const std::uint8_t> is_wanted, const Collect& collect) const {
    return is_wanted.empty() ? collect_from<Item>(AllPairs{*this}, collect)
                             : collect_from<Item>(WantedPairs(*this, is_wanted), collect);
  }

 private:
  /// All pairs whose boxes meet.
  struct AllPairs {
    const BoxTree& tree;

    bool has_any(std::uint32_t a, std::uint32_t b) const { return tree.nodes_[a].meets(tree.nodes_[b]); }
    bool has_any_of(std::size_t i, std::uint32_t node) const { return tree.boxes_[i].meets(tree.nodes_[node]); }
    bool has(std::size_t i, std::size_t j) const { return tree.boxes_[i].meets(tree.boxes_[j]); }
  };

  /// Those of which at least one item is wanted.
  class WantedPairs {
   public:
    WantedPairs(const BoxTree& tree, std::span<const std::uint8_t> is_wanted)
        : tree_(tree), is_wanted_(tree.items_.size()), wanted_(tree.nodes_.size(), empty_box) {
      for (std::size_t i = 0; i < is_wanted_.size(); ++i) {
        is_wanted_[i] = is_wanted[tree.items_[i]];
        Box& leaf = wanted_[tree.leaf_count_ + i / leaf_size];
        if (is_wanted_[i]) leaf = hull(leaf, tree.boxes_[i]);
      }
      for (std::size_t node = tree.leaf_count_; node-- > 1;)
        wanted_[node] = hull(wanted_[2 * node], wanted_[2 * node + 1]);
    }
    /// May there be any between two nodes, or within one?
    bool has_any(std::uint32_t a, std::uint32_t b) const {
      return tree_.nodes_[a].meets(tree_.nodes_[b]) &&
             (wanted_[a].meets(tree_.nodes_[b]) || tree_.nodes_[a].meets(wanted_[b]));
    }
    /// Of one item with those of a node?
    bool has_any_of(std::size_t i, std::uint32_t node) const {
      return tree_.boxes_[i].meets(is_wanted_[i] ? tree_.nodes_[node] : wanted_[node]);
    }
    bool has(std::size_t i, std::size_t j) const {
      return (is_wanted_[i] | is_wanted_[j]) != 0 && tree_.boxes_[i].meets(tree_.boxes_[j]);
    }

   private:
    const BoxTree& tree_;
    std::vector<std::uint8_t> is_wanted_;
    RawVector<Box> wanted_;  ///< of each node: the hull of the wanted items
  };

  template <class Item, class Pairs, class Collect>
  std::vector<Item> collect_from(const Pairs& pairs, const Collect& collect) const {
    std::vector<Search> searches;
    if (!items_.empty()) plan_searches(1, pairs, searches);
    return parallel_collect<Item>(searches.size(), 1,
                                  [&](std::size_t begin, std::size_t end, std::vector<Item>& found) {
                                    const auto visit = [&](std::uint32_t i, std::uint32_t j) { collect(found, i, j); };
                                    for (const auto& [a, b] : std::span(searches).subspan(begin, end - begin))
                                      if (a == b)
                                        descend_self(a, pairs, visit);
                                      else if (pairs.has_any(a, b))
                                        descend_both(a, b, pairs, visit);
                                  });
  }

  /// For the pairs within one node or between two.
  using Search = std::array<std::uint32_t, 2>;

  template <class Pairs>
  void plan_searches(std::uint32_t node, const Pairs& pairs, std::vector<Search>& searches) const {
    if (!pairs.has_any(node, node)) return;
    constexpr std::uint32_t first_alone = 128;
    if (is_leaf(node) || node >= first_alone || thread_count() == 1) {
      searches.push_back({node, node});
      return;
    }
    ++work_done.box_tree_nodes;
    plan_searches(2 * node, pairs, searches);
    plan_searches(2 * node + 1, pairs, searches);
    searches.push_back({2 * node, 2 * node + 1});
  }

  static constexpr std::uint32_t leaf_size = 4;

  bool is_leaf(std::uint32_t node) const { return node >= leaf_count_; }
  /// Where the items of a leaf begin and end in `items_`.
  std::array<std::size_t, 2> places_of(std::uint32_t leaf) const {
    const std::size_t begin = std::min<std::size_t>(std::size_t{leaf - leaf_count_} * leaf_size, items_.size());
    return {begin, std::min<std::size_t>(begin + leaf_size, items_.size())};
  }

  template <class Shape, class Visit>
  void descend(std::uint32_t node, const Shape& shape, Visit& visit) const {
    ++work_done.box_tree_nodes;
    if (!is_leaf(node)) {
      for (const std::uint32_t child : {2 * node, 2 * node + 1})
        if (nodes_[child].meets(shape)) descend(child, shape, visit);
      return;
    }
    const auto [begin, end] = places_of(node);
    for (std::size_t i = begin; i < end; ++i)
      if (boxes_[i].meets(shape)) {
        ++work_done.box_pairs;
        visit(items_[i]);
      }
  }

  template <class Pairs, class Visit>
  void descend_self(std::uint32_t node, const Pairs& pairs, const Visit& visit) const {
    if (!pairs.has_any(node, node)) return;
    ++work_done.box_tree_nodes;
    if (!is_leaf(node)) {
      descend_self(2 * node, pairs, visit);
      descend_self(2 * node + 1, pairs, visit);
      if (pairs.has_any(2 * node, 2 * node + 1)) descend_both(2 * node, 2 * node + 1, pairs, visit);
      return;
    }
    const auto [begin, end] = places_of(node);
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = i + 1; j < end; ++j) visit_if_meeting(i, j, pairs, visit);
  }

  template <class Pairs, class Visit>
  void visit_if_meeting(std::size_t i, std::size_t j, const Pairs& pairs, const Visit& visit) const {
    if (!pairs.has(i, j)) return;
    ++work_done.box_pairs;
    visit(items_[i], items_[j]);
  }

  /// The two meet.
  template <class Pairs, class Visit>
  void descend_both(std::uint32_t a, std::uint32_t b, const Pairs& pairs, const Visit& visit) const {
    ++work_done.box_tree_nodes;
    if (!is_leaf(a)) {  // both are on the same level
      for (const std::uint32_t i : {2 * a, 2 * a + 1})
        for (const std::uint32_t j : {2 * b, 2 * b + 1})
          if (pairs.has_any(i, j)) descend_both(i, j, pairs, visit);
      return;
    }
    const auto [begin_a, end_a] = places_of(a);
    const auto [begin_b, end_b] = places_of(b);
    for (std::size_t i = begin_a; i < end_a; ++i) {
      if (!pairs.has_any_of(i, b)) continue;
      for (std::size_t j = begin_b; j < end_b; ++j) visit_if_meeting(i, j, pairs, visit);
    }
  }

  std::vector<std::uint32_t> items_;  // in Morton order
  RawVector<Box> boxes_;              // of these
  RawVector<Box> nodes_;              // from 1 on
  std::uint32_t leaf_count_ = 1;      // a power of two
};

}  // namespace ccdt
