#include "tools/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/terminal.h"
#include "tools/wrapped_lines.h"

namespace ccdt::tools {
namespace {

constexpr std::chrono::milliseconds least_pause{100};
constexpr int bar_width = 30;

}  // namespace

std::string progress_line(std::string_view stage, std::uint64_t done, std::uint64_t total, double seconds,
                          int columns) {
  std::string line = printable(stage);
  if (total > 0) {
    const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto full = static_cast<std::size_t>(part * bar_width);
    line += " [" + std::string(full, '#') + std::string(bar_width - full, '.') + "] " +
            std::to_string(static_cast<int>(100 * part)) + "%";
  } else if (done > 0) {
    line += " " + std::to_string(done);
  }
  line += " " + std::to_string(static_cast<long long>(seconds)) + " s";
  return line.substr(0, static_cast<std::size_t>(std::max(0, columns - 1)));
}

ProgressBar::ProgressBar()
    : on_terminal_(isatty(STDERR_FILENO) == 1 && !is_quiet()), begin_(Clock::now()), last_(begin_ - least_pause) {}

ProgressBar::~ProgressBar() {
  erase();
}

Progress ProgressBar::progress() {
  if (!on_terminal_) return {};
  return [this](std::string_view stage, std::uint64_t done, std::uint64_t total) { draw(stage, done, total); };
}

void ProgressBar::draw(std::string_view stage, std::uint64_t done, std::uint64_t total) {
  const auto now = Clock::now();
  if (stage == stage_ && now - last_ < least_pause) return;
  stage_ = stage;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  std::fprintf(stderr, "\r\033[K%s",
               progress_line(stage, done, total, seconds, terminal_columns(STDERR_FILENO)).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::erase() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void ProgressBar::say(const std::string& line) {
  erase();
  if (!is_quiet()) print_error_line(line);
}

}  // namespace ccdt::tools
