#pragma once

#include <chrono>
#include <new>
#include <string>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/base/progress.h"

namespace ccdt::tools {

/// A line at the bottom of the terminal that shows the progress: stage, bar, percentage and the seconds since the
/// start. It is drawn at most a few times a second and erased at the end. If standard error is not a terminal, nothing
/// is drawn.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// The callback for the work, valid as long as this object lives. Empty if nothing is drawn.
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

/// Calls `run(progress)`, and shows the progress in a bar.
/// \param file  what is worked on
/// \throw MemoryError  in place of `std::bad_alloc`; names the stage and the file
template <class Run>
auto with_progress(const std::string& file, const Run& run) {
  ProgressBar bar;
  std::string stage = "read";
  const Progress progress = [&, draw = bar.progress()](std::string_view now, std::uint64_t done, std::uint64_t total) {
    if (now != stage) stage = now;
    report(draw, now, done, total);
  };
  try {
    return run(progress);
  } catch (const std::bad_alloc&) {
    throw MemoryError("out of memory in the stage '" + stage + "'", {.file = file},
                      "allow more memory, use a machine with more memory, a coarser model or a larger --edge-length");
  }
}

/// The line itself, no longer than `columns` characters.
std::string progress_line(std::string_view stage, std::uint64_t done, std::uint64_t total, double seconds, int columns);

}  // namespace ccdt::tools
