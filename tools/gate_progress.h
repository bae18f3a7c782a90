#pragma once

#include <chrono>
#include <string>

#include "bench/gate/measure_times.h"
#include "tools/progress_bar.h"

namespace ccdt::tools {

/// Shows how far a gate is, with a total and the time left: as a bar on a terminal, and otherwise as a line every half
/// minute, so that nobody takes it for dead.
class GateProgress {
 public:
  GateProgress();

  void show(const gate::TimeProgress& progress);

  /// For other work that is counted.
  Progress counted();

 private:
  using Clock = std::chrono::steady_clock;

  void show_line(std::string_view stage, std::uint64_t done, std::uint64_t total);

  ProgressBar bar_;
  Progress draw_;
  Clock::time_point begin_, last_;
};

/// "2 of 10 cases, about 40 s left"
std::string words_of(const gate::TimeProgress& progress, double seconds);

}  // namespace ccdt::tools
