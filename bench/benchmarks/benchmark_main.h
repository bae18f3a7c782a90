#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/benchmarks/stages.h"

/// The common parts of the benchmark programs: names, sizes, counters and command line.
///
/// The arguments of each program are those of Google Benchmark, `--input FILE` any number of times, `--largest N` and
/// `--no-complexity`. Repetitions are interleaved by default, so that all strategies see the same machine. The exit
/// code is 1 if a benchmark found a fault, 2 if the arguments are wrong.
namespace ccdt::benchmarks {

/// One way to do something, over several sizes of one subject.
struct Family {
  std::string name;                            ///< stage/strategy/subject
  std::vector<std::int64_t> sizes;             ///< the last part of the benchmarks' names; empty: one benchmark without
  benchmark::BigO complexity = benchmark::oN;  ///< the complexity to fit

  /// Runs once and returns the error of the result; empty if it is right. Called once for each size, before its first
  /// measurement; a benchmark with a fault is not measured.
  std::function<std::string(std::int64_t size)> find_fault;
  std::function<void(benchmark::State&, std::int64_t size)> measure;
};

void add_family(const Family& family);

/// The user's files, on which a stage is measured in addition to the models.
using Files = std::vector<std::filesystem::path>;

/// Defined by each program: adds its benchmarks.
void add_benchmarks(const Files& files);

/// One strategy of a stage.
struct StageBenchmark {
  std::string name;  ///< stage/strategy
  benchmark::BigO complexity = benchmark::oN;
  std::int64_t largest = model_sizes.back();  ///< of the models' sizes
  bool flattened_too = false;                 ///< are there families of the flattened models as well?
  std::function<std::string(const Stages&)> find_fault;
  std::function<void(benchmark::State&, const Stages&)> measure;
};

/// Families `name/MODEL` over the sizes of each of the paper's models, or `name/flat-MODEL` if flattened, and a
/// benchmark `name/FILE` for each file.
void add_stage(const StageBenchmark& stage, const Files& files);

/// Sets, after the measurement: `vertices` and `cells`, `vertices/s` and `cells/s` (of CPU time; items_per_second are
/// the vertices too), and the size for the complexity fit, which is that of the vertices.
///
/// \param cells  tetrahedra; 0: the stage has none
void set_counters(benchmark::State& state, std::size_t vertices, std::size_t cells);

/// Sets a counter unless it is 0: the statistics of the repetitions would divide by it, and JSON has no NaN.
void set_count(benchmark::State& state, const std::string& name, std::size_t count);

/// Measures the time of `run()`, without releasing its result.
template <class Run>
void time_runs(benchmark::State& state, const Run& run) {
  for (auto _ : state) {
    auto result = std::make_optional(run());
    benchmark::DoNotOptimize(result);
    state.PauseTiming();
    result.reset();
    state.ResumeTiming();
  }
}

}  // namespace ccdt::benchmarks
