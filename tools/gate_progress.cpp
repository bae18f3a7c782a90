#include "tools/gate_progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

constexpr std::chrono::seconds pause_of_lines{30};
constexpr double seconds_per_minute = 60;

std::string duration(double seconds) {
  if (seconds < 2 * seconds_per_minute) return std::to_string(std::lround(std::ceil(seconds))) + " s";
  return std::to_string(std::lround(std::ceil(seconds / seconds_per_minute))) + " min";
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::string words_of(const gate::TimeProgress& progress, double seconds) {
  std::string text = std::to_string(progress.decided) + " of " + std::to_string(progress.cases) + " cases";
  if (progress.pairs == 0) return text;
  const double left = static_cast<double>(progress.expected - progress.pairs) / static_cast<double>(progress.pairs);
  return text + ", about " + duration(left * seconds) + " left";
}

GateProgress::GateProgress() : draw_(bar_.progress()), begin_(Clock::now()), last_(begin_) {}

void GateProgress::show(const gate::TimeProgress& progress) {
  show_line("decided " + words_of(progress, seconds_since(begin_)), progress.pairs, progress.expected);
}

Progress GateProgress::counted() {
  return [this](std::string_view stage, std::uint64_t done, std::uint64_t total) { show_line(stage, done, total); };
}

void GateProgress::show_line(std::string_view stage, std::uint64_t done, std::uint64_t total) {
  if (draw_) return draw_(stage, done, total);
  const auto now = Clock::now();
  if (is_quiet() || now - last_ < pause_of_lines) return;
  last_ = now;
  print_error_line("ccdt gate: " + std::string(stage) + " (" + std::to_string(done) + " of about " +
                   std::to_string(total) + " after " + duration(seconds_since(begin_)) + ")");
  std::fflush(stderr);
}

}  // namespace ccdt::tools
