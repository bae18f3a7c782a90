// Look-ups: a hash table with open addressing, and a search tree.

#include <benchmark/benchmark.h>

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "studies/gate/layouts/kernels/work.h"

namespace kernels {
namespace {

class HashTable {
 public:
  void insert(std::uint64_t key) {
    std::size_t slot = first_slot(key);
    while (slots_[slot] != 0 && slots_[slot] != key) slot = next(slot);
    slots_[slot] = key;
  }

  bool contains(std::uint64_t key) const {
    for (std::size_t slot = first_slot(key); slots_[slot] != 0; slot = next(slot))
      if (slots_[slot] == key) return true;
    return false;
  }

 private:
  static constexpr std::size_t size = 2048;
  static std::size_t first_slot(std::uint64_t key) { return key * 0x9e3779b97f4a7c15 >> 53; }
  static std::size_t next(std::size_t slot) { return (slot + 1) % size; }

  std::array<std::uint64_t, size> slots_ = {};  ///< 0: empty
};

[[gnu::noinline]] int count_known(const HashTable& table, const std::vector<std::uint64_t>& keys) {
  int known = 0;
  for (const std::uint64_t key : keys) known += table.contains(key) ? 1 : 0;
  return known;
}

void hash(benchmark::State& state) {
  HashTable table;
  for (int i = 0; i < 1200; ++i) table.insert(static_cast<std::uint64_t>(7 * i + 1));
  Random random(3);
  std::vector<std::uint64_t> keys(400);
  for (std::uint64_t& key : keys)
    key = static_cast<std::uint64_t>(random.below(2) ? 7 * random.below(1200) + 1 : 1 + random.below(10000));
  const int passes = passes_of("hash");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(count_known(table, keys));
}
BENCHMARK(hash);

struct Node {
  int key = 0;
  int left = -1, right = -1;  ///< -1: none
};

class Tree {
 public:
  void insert(int key) {
    const int added = static_cast<int>(nodes_.size());
    nodes_.push_back({key, -1, -1});
    for (int i = 0; i < added;) {
      Node& node = nodes_[static_cast<std::size_t>(i)];
      int& child = key < node.key ? node.left : node.right;
      if (child < 0) {
        child = added;
        return;
      }
      i = child;
    }
  }

  /// The sum of the keys in [first, last) below a node.
  long sum(int first, int last, int from = 0) const {
    if (from < 0) return 0;
    const Node& node = nodes_[static_cast<std::size_t>(from)];
    long total = 0;
    if (first < node.key) total += sum(first, last, node.left);
    if (first <= node.key && node.key < last) total += node.key;
    if (node.key < last) total += sum(first, last, node.right);
    return total;
  }

 private:
  std::vector<Node> nodes_;
};

[[gnu::noinline]] long sum_ranges(const Tree& tree, const std::vector<int>& starts) {
  long total = 0;
  for (const int start : starts) total += tree.sum(start, start + 8);
  return total;
}

void tree(benchmark::State& state) {
  constexpr int size = 2000;
  std::vector<int> keys(size);
  std::iota(keys.begin(), keys.end(), 0);
  Random random(4);
  for (int i = size - 1; i > 0; --i)
    std::swap(keys[static_cast<std::size_t>(i)], keys[static_cast<std::size_t>(random.below(i + 1))]);
  Tree tree;
  for (const int key : keys) tree.insert(key);
  std::vector<int> starts(200);
  for (int& start : starts) start = random.below(size);
  const int passes = passes_of("tree");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(sum_ranges(tree, starts));
}
BENCHMARK(tree);

}  // namespace
}  // namespace kernels
