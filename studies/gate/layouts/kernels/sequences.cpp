// Sorting, and a queue of events.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "studies/gate/layouts/kernels/work.h"

namespace kernels {
namespace {

using Block = std::array<int, 64>;

[[gnu::noinline]] int sort_blocks(const std::vector<Block>& blocks) {
  int medians = 0;
  for (Block block : blocks) {
    std::sort(block.begin(), block.end());
    medians ^= block[block.size() / 2];
  }
  return medians;
}

void sort(benchmark::State& state) {
  std::vector<Block> blocks(40);
  Random random(1);
  for (Block& block : blocks)
    for (int& value : block) value = random.below(1000000);
  const int passes = passes_of("sort");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(sort_blocks(blocks));
}
BENCHMARK(sort);

/// A heap of numbers with the smallest on top.
class Heap {
 public:
  void push(unsigned value) {
    values_.push_back(value);
    std::size_t i = values_.size() - 1;
    while (i > 0 && values_[i] < values_[(i - 1) / 2]) {
      std::swap(values_[i], values_[(i - 1) / 2]);
      i = (i - 1) / 2;
    }
  }

  unsigned pop() {
    const unsigned top = values_.front();
    values_.front() = values_.back();
    values_.pop_back();
    std::size_t i = 0;
    for (;;) {
      std::size_t child = 2 * i + 1;
      if (child >= values_.size()) return top;
      if (child + 1 < values_.size() && values_[child + 1] < values_[child]) ++child;
      if (values_[i] <= values_[child]) return top;
      std::swap(values_[i], values_[child]);
      i = child;
    }
  }

 private:
  std::vector<unsigned> values_;
};

[[gnu::noinline]] unsigned run_events(Heap heap, const std::vector<unsigned>& delays) {
  unsigned now = 0;
  for (const unsigned delay : delays) {
    now = heap.pop();
    heap.push(now + delay);
  }
  return now;
}

void heap(benchmark::State& state) {
  Random random(2);
  Heap full;
  for (int i = 0; i < 500; ++i) full.push(static_cast<unsigned>(random.below(1000)));
  std::vector<unsigned> delays(400);
  for (unsigned& delay : delays) delay = static_cast<unsigned>(1 + random.below(1000));
  const int passes = passes_of("heap");
  for (auto _ : state)
    for (int pass = 0; pass < passes; ++pass) benchmark::DoNotOptimize(run_events(full, delays));
}
BENCHMARK(heap);

}  // namespace
}  // namespace kernels
