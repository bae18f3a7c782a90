#pragma once

#include <filesystem>
#include <string>

#include "bench/gate/rules.h"
#include "bench/gate/timed_targets.h"

namespace ccdt::gate {

/// Two programs on Google Benchmark. Each benchmark name is a case, and its real time the figure; with the figure
/// "cpu_time" in the rules, its processor time. The counters of each benchmark are measured too.
///
/// \param arguments  for both programs; they override the defaults, one repetition of 0.05 s
/// \param folder     for scratch files; exists
TimedTarget benchmark_target(const Programs& programs, const Command& arguments, const Rules& rules,
                             const baselines::Limits& limits, const std::filesystem::path& folder);

/// Does a command look like one of Google Benchmark?
bool is_benchmark(const Command& command);

/// The names of the benchmarks that a command would run; empty if it cannot tell.
std::vector<std::string> list_benchmarks(const Command& command, const std::filesystem::path& folder);

}  // namespace ccdt::gate
