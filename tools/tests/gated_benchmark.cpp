#include <benchmark/benchmark.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

/// A program on Google Benchmark for tests of gates. The variable GATED says what is wrong with it:
///   crash        BM_sum crashes
///   allocate     BM_sum allocates once more
///   call         BM_sum makes one more system call
///   slow         BM_sum does twice the work
///   environment  the work of BM_sum depends on the size of the environment
///   count        the counter of BM_walk is 13 instead of 12
namespace {

bool is(const std::string& fault) {
  const char* text = std::getenv("GATED");
  return text != nullptr && fault == text;
}

[[gnu::noinline]] std::uint64_t add_up(std::uint64_t count) {
  std::uint64_t sum = 0;
  for (std::uint64_t i = 0; i < count; ++i) benchmark::DoNotOptimize(sum += i);
  return sum;
}

std::uint64_t size_of_environment() {
  std::uint64_t size = 0;
  for (char** entry = environ; *entry != nullptr; ++entry) size += std::string(*entry).size();
  return size;
}

void sum(benchmark::State& state) {
  if (is("crash")) std::raise(SIGSEGV);
  const std::uint64_t count = is("environment") ? 10 * size_of_environment() : 5000;
  for (auto _ : state) {
    benchmark::DoNotOptimize(add_up(count));
    if (is("slow")) benchmark::DoNotOptimize(add_up(count));
    if (is("allocate")) {
      void* block = std::malloc(8 + count);
      benchmark::DoNotOptimize(block);
      std::free(block);
    }
    if (is("call")) benchmark::DoNotOptimize(getppid());
  }
}

void walk(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(add_up(3000));
  state.counters["steps"] = is("count") ? 13 : 12;
  state.counters["rate"] = 1.5;
  state.counters["nothing"] = std::numeric_limits<double>::quiet_NaN();
}

BENCHMARK(sum)->Name("BM_sum");
BENCHMARK(walk)->Name("BM_walk");

}  // namespace

BENCHMARK_MAIN();
