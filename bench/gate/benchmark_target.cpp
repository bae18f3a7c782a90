#include "bench/gate/benchmark_target.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/gate/foreign_json.h"
#include "bench/run/statistics.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

constexpr double most_seconds_to_list = 10;

double number_of(const Figure& figure) {
  if (!figure.samples.empty() && figure.text.empty()) return bench::median(figure.samples);
  if (figure.text == "Infinity") return std::numeric_limits<double>::infinity();
  if (figure.text == "-Infinity") return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

MeasuredCase measured_case(const CaseFigures& one, const std::string& time) {
  MeasuredCase measured;
  const Figure* status = find_figure(one, "status");
  if (status != nullptr && status->text != "ok") measured.failure = status->text;
  if (const Figure* seconds = find_figure(one, "seconds." + time)) measured.seconds = bench::median(seconds->samples);
  measured.timed_seconds = one.timed_seconds;
  for (const Figure& figure : one.figures)
    if (figure.name.starts_with(counter_prefix))
      measured.counters[figure.name.substr(std::string(counter_prefix).size())] = number_of(figure);
  return measured;
}

/// The measurements of a program on Google Benchmark. The error of a benchmark is a better reason than the exit code
/// that some programs then have.
/// \throw ProgramFailed
Measured read_measured(const std::filesystem::path& file, const baselines::ProcessResult& ended, Side side,
                       const Command& command, const std::string& time) {
  Recording recording;
  std::string fault = "no benchmark ran";
  if (std::filesystem::exists(file)) {
    try {
      add_google_benchmark(parse_benchmark_json(io::read_whole_file(file).bytes), recording);
    } catch (const nlohmann::json::exception& error) {
      fault = std::string("the output of --benchmark_out cannot be read: ") + error.what();
      recording.cases.clear();
    }
  }
  Measured measured;
  for (const CaseFigures& one : recording.cases) measured[one.name] = measured_case(one, time);
  const bool has_error = std::ranges::any_of(measured, [](const auto& one) { return !one.second.failure.empty(); });
  if (ended.status != baselines::RunStatus::ok && !has_error) fail(side, command, reason_of(ended));
  if (measured.empty()) fail(side, command, fault);
  return measured;
}

}  // namespace

bool is_benchmark(const Command& command) {
  return std::ranges::any_of(command, [](const std::string& word) { return word.starts_with("--benchmark"); });
}

std::vector<std::string> list_benchmarks(const Command& command, const std::filesystem::path& folder) {
  Command listing = command;
  listing.emplace_back("--benchmark_list_tests=true");
  const auto log = folder / "benchmarks.txt";
  const auto ended =
      baselines::run_program(listing, {.log = log, .limits = baselines::Limits{.seconds = most_seconds_to_list}});
  std::vector<std::string> names;
  if (ended.status != baselines::RunStatus::ok) return names;
  std::ifstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) names.push_back(line);
  return names;
}

TimedTarget benchmark_target(const Programs& programs, const Command& arguments, const Rules& rules,
                             const baselines::Limits& limits, const std::filesystem::path& folder) {
  const auto file = std::filesystem::absolute(folder) / "timed.json";
  const std::string time = rules.time.figure == "cpu_time" ? "cpu_time" : "real_time";
  TimedTarget target = {std::filesystem::path(programs.head.front()).filename().string(), time};
  target.run = [=](const RunRequest& request) {
    Command words = {"--benchmark_repetitions=1", "--benchmark_min_time=0.05"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    if (!request.cases.empty()) words.push_back("--benchmark_filter=" + pattern_of(request.cases));
    words.insert(words.end(), {"--benchmark_out=" + file.string(), "--benchmark_out_format=json"});
    const Command command = command_of(programs, request, words);
    std::filesystem::remove(file);
    return read_measured(file, try_run(request, command, limits), request.side, command, time);
  };
  target.command = [=](Side side, const std::string& name) {
    Command words = arguments;
    std::erase_if(words, [](const std::string& word) { return word.starts_with("--benchmark_filter="); });
    words.push_back("--benchmark_filter=" + pattern_of({name}));
    return baselines::command_line(command_of(programs, {side}, words));
  };
  target.list = [=](Side side) { return list_benchmarks(command_of(programs, {side}, arguments), folder); };
  return target;
}

}  // namespace ccdt::gate
