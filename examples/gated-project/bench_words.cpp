#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "words.h"

namespace {

/// The same text on every machine: 2,000 words of one to eight letters.
const std::string& text() {
  static const std::string made = [] {
    std::mt19937 random(1);
    std::string words;
    for (int i = 0; i < 2000; ++i) {
      for (unsigned letters = 1 + random() % 8; letters > 0; --letters) words += static_cast<char>('a' + random() % 26);
      words += ' ';
    }
    return words;
  }();
  return made;
}

// The counters are counts of work: the same in every run, so the gate compares them exactly.

void split_text(benchmark::State& state) {
  std::size_t found = 0;
  for (auto _ : state) benchmark::DoNotOptimize(found = words::split(text()).size());
  state.counters["words"] = static_cast<double>(found);
}
BENCHMARK(split_text);

void make_vocabulary(benchmark::State& state) {
  const auto all = words::split(text());
  std::int64_t comparisons = 0;
  for (auto _ : state) benchmark::DoNotOptimize(words::vocabulary(all, comparisons = 0));
  state.counters["comparisons"] = static_cast<double>(comparisons);
}
BENCHMARK(make_vocabulary);

void find_words(benchmark::State& state) {
  const auto all = words::split(text());
  std::int64_t comparisons = 0;
  const auto known = words::vocabulary(all, comparisons);
  for (auto _ : state) {
    comparisons = 0;
    for (const auto word : all) benchmark::DoNotOptimize(words::contains(known, word, comparisons));
  }
  state.counters["comparisons"] = static_cast<double>(comparisons);
}
BENCHMARK(find_words);

}  // namespace
