// Loops of 10 ns to 10 s per iteration, on Google Benchmark. The variable SLOWER multiplies the work of each.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>

namespace {

/// A chain of steps that depend on each other: none of them run in parallel, and they touch no memory.
std::uint64_t chain(std::int64_t steps) {
  std::uint64_t x = 88172645463325252U;
  for (std::int64_t i = 0; i < steps; ++i) x += x >> 1;
  return x;
}

double slower() {
  const char* text = std::getenv("SLOWER");
  return text == nullptr ? 1 : std::atof(text);
}

/// `steps` are those of one iteration.
void run_chain(benchmark::State& state) {
  const auto steps = static_cast<std::int64_t>(static_cast<double>(state.range(0)) * slower());
  for (auto _ : state) benchmark::DoNotOptimize(chain(steps));
}

// A step takes two cycles, about half a nanosecond.
BENCHMARK(run_chain)->Name("10ns")->Arg(20);
BENCHMARK(run_chain)->Name("100ns")->Arg(200);
BENCHMARK(run_chain)->Name("1us")->Arg(2000);
BENCHMARK(run_chain)->Name("10us")->Arg(20000);
BENCHMARK(run_chain)->Name("100us")->Arg(200000);
BENCHMARK(run_chain)->Name("1ms")->Arg(2000000);
BENCHMARK(run_chain)->Name("10ms")->Arg(20000000);
BENCHMARK(run_chain)->Name("100ms")->Arg(200000000);
BENCHMARK(run_chain)->Name("1s")->Arg(2000000000);
BENCHMARK(run_chain)->Name("10s")->Arg(20000000000);

}  // namespace

BENCHMARK_MAIN();
