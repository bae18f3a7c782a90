#pragma once

#include <chrono>
#include <string>

#include "engine/base/progress.h"

namespace ccdt::tools {

/// A line at the bottom of the terminal that says how far the work is: stage, bar, per cent and the seconds since the
/// start. It is drawn a few times a second at most and erased at the end. Where standard error is no terminal, nothing
/// is drawn.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// To be handed to the work; valid as long as this object is. Empty where nothing is drawn.
  Progress progress();
  void erase();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::string_view stage, std::uint64_t done, std::uint64_t total);

  bool on_terminal_;
  bool drawn_ = false;
  std::string stage_;
  Clock::time_point begin_, last_;
};

/// The line itself, no longer than `columns` characters.
std::string progress_line(std::string_view stage, std::uint64_t done, std::uint64_t total, double seconds, int columns);

}  // namespace ccdt::tools
