#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "bench/run/numbers.h"
#include "engine/base/parallel.h"
#include "engine/base/progress.h"
#include "tools/limit_errors.h"

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
  /// Prints a line for people, above the bar.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::string_view stage, std::uint64_t done, std::uint64_t total);

  bool on_terminal_;
  bool drawn_ = false;
  std::string stage_;
  Clock::time_point begin_, last_;
};

/// Calls `run(progress)` on so many threads (0: all cores), and shows the progress in a bar. Errors of limits name the
/// stage and the file.
/// \param file  what is worked on
/// \throw ...   see `with_stage_of_limits`
template <class Run>
auto with_progress(const std::string& file, unsigned threads, const Run& run) {
  ProgressBar bar;
  std::string stage = "read";
  const Progress progress = [&, draw = bar.progress()](std::string_view now, std::uint64_t done, std::uint64_t total) {
    constexpr std::uint64_t large_mesh = 5'000'000;
    if (now == "estimate") {
      if (done > large_mesh) bar.say("about " + bench::with_separators(done) + " tetrahedra will be made");
      return;
    }
    if (now != stage) stage = now;
    report(draw, now, done, total);
  };
  return with_stage_of_limits(file, stage, [&] { return with_threads(threads, [&] { return run(progress); }); });
}

/// The line itself, no longer than `columns` characters.
std::string progress_line(std::string_view stage, std::uint64_t done, std::uint64_t total, double seconds, int columns);

}  // namespace ccdt::tools
