#include "bench/gate/timed_targets.h"

#include <nlohmann/json.hpp>

#include "bench/cases/run_case.h"
#include "bench/json.h"
#include "bench/statistics.h"
#include "engine/io/files.h"

namespace ccdt::gate {
namespace {

using Command = std::vector<std::string>;

constexpr const char* whole_process = "wall";

std::string program_of(const Programs& programs, Side side) {
  return std::filesystem::absolute(side == Side::base ? programs.base : programs.head).lexically_normal().string();
}

Command command_of(const Programs& programs, Side side, const Command& arguments) {
  Command command = {program_of(programs, side)};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

[[noreturn]] void fail(Side side, const Command& command, const std::string& what) {
  throw ProgramFailed(side, "the " + std::string(name_of(side)) + " program failed: " + what, {.file = command.front()},
                      baselines::command_line(command));
}

/// Runs a command with an environment that is larger by this many bytes.
/// \param folder  where it runs; empty: where this process runs
baselines::ProcessResult try_run(const RunRequest& request, const Command& command, const baselines::Limits& limits,
                                 const std::filesystem::path& folder = {}) {
  return baselines::run_program(
      command,
      {.folder = folder, .environment = {{"CCDT_GATE_PADDING", std::string(request.padding, 'x')}}, .limits = limits});
}

/// \throw ProgramFailed
void check_end(const baselines::ProcessResult& ended, Side side, const Command& command) {
  if (ended.status == baselines::RunStatus::ok) return;
  const std::string code = "exit code " + std::to_string(ended.exit_code);
  fail(side, command, ended.exit_code == 0 || ended.reason == code ? ended.reason : code + ": " + ended.reason);
}

/// \throw ProgramFailed
baselines::ProcessResult run(const RunRequest& request, const Command& command, const baselines::Limits& limits,
                             const std::filesystem::path& folder = {}) {
  baselines::ProcessResult result = try_run(request, command, limits, folder);
  check_end(result, request.side, command);
  return result;
}

/// "seconds.mesh" in the report of a run.
double figure_of(const std::filesystem::path& report, const std::string& figure) {
  static constexpr bench::DocumentKind kind = {"ccdt.run/1", "not a report of schema ccdt.run/1",
                                               "the program must be ccdt"};
  double seconds = 0;
  bench::parse_document(report, kind, [&](const bench::Json& json) {
    const bench::Json* value = &json;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
      end = figure.find('.', begin);
      value = &value->at(figure.substr(begin, end == std::string::npos ? end : end - begin));
    }
    value->get_to(seconds);
  });
  return seconds;
}

/// The times of each benchmark's repetitions.
/// \throw ProgramFailed
/// \throw nlohmann::json::exception  this is not output of Google Benchmark
std::map<std::string, std::vector<double>> times_in(const bench::Json& json, Side side, const Command& command) {
  static const std::map<std::string, double> units = {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"s", 1}};
  std::map<std::string, std::vector<double>> times;
  for (const bench::Json& run : json.at("benchmarks")) {
    const auto name = run.at("name").get<std::string>();
    if (run.value("error_occurred", false)) fail(side, command, name + ": " + run.value("error_message", ""));
    if (run.value("run_type", "iteration") != "iteration") continue;
    const auto unit = units.find(run.value("time_unit", "ns"));
    if (unit == units.end()) fail(side, command, name + ": its time has an unknown unit");
    times[run.value("run_name", name)].push_back(run.at("real_time").get<double>() * unit->second);
  }
  return times;
}

/// The measurements of a program on Google Benchmark. The error of a benchmark is a better reason than the exit code
/// that some programs then have.
/// \throw ProgramFailed
std::map<std::string, std::vector<double>> times_of_benchmarks(const std::filesystem::path& file,
                                                               const baselines::ProcessResult& ended, Side side,
                                                               const Command& command) {
  std::map<std::string, std::vector<double>> times;
  std::string fault = "no benchmark ran";
  if (std::filesystem::exists(file)) {
    try {
      times = times_in(bench::Json::parse(io::read_whole_file(file).bytes), side, command);
    } catch (const nlohmann::json::exception& error) {
      fault = std::string("the output of --benchmark_out cannot be read: ") + error.what();
    }
  }
  check_end(ended, side, command);
  if (times.empty()) fail(side, command, fault);
  return times;
}

/// A pattern that only these names match.
std::string pattern_of(const std::set<std::string>& names) {
  std::string pattern;
  for (const std::string& name : names) {
    pattern += pattern.empty() ? "^(" : "|";
    for (const char c : name) {
      if (std::string_view(".^$|()[]{}*+?\\").find(c) != std::string_view::npos) pattern += '\\';
      pattern += c;
    }
  }
  return pattern + ")$";
}

TimedTarget sweep_target(const Programs& programs, const cases::Case& asked, const Rules& rules,
                         const std::filesystem::path& folder) {
  const std::string figure = time_rules_of(rules, asked.name).figure;
  const auto report = folder / "timed.json";
  TimedTarget target = {asked.name, figure};
  target.run = [=](const RunRequest& request) -> std::map<std::string, double> {
    const Command command =
        command_of(programs, request.side, cases::mesh_arguments(folder, asked, "timed.mesh", "timed.json"));
    std::filesystem::remove(report);
    const baselines::ProcessResult result = run(request, command, asked.limits, folder);
    return {{asked.name, figure == whole_process ? result.seconds : figure_of(report, figure)}};
  };
  target.command = [=](Side side, const std::string&) {
    return baselines::command_line(
        command_of(programs, side, cases::mesh_arguments(folder, asked, "again.mesh", "again.json")));
  };
  return target;
}

}  // namespace

std::vector<TimedTarget> sweep_targets(const Programs& programs, std::span<const cases::Case> cases, const Rules& rules,
                                       const std::filesystem::path& folder) {
  // In a separate folder without inputs, the commands contain the full paths of the inputs.
  const auto scratch = std::filesystem::absolute(folder) / "timed";
  std::filesystem::create_directories(scratch);
  std::vector<TimedTarget> targets;
  for (const cases::Case& asked : cases)
    if (is_gated(rules, Layer::time, asked.name, time_rules_of(rules, asked.name).figure))
      targets.push_back(sweep_target(programs, asked, rules, scratch));
  return targets;
}

TimedTarget benchmark_target(const Programs& programs, const std::vector<std::string>& arguments,
                             const baselines::Limits& limits, const std::filesystem::path& folder) {
  const auto file = std::filesystem::absolute(folder) / "timed.json";
  TimedTarget target = {programs.head.filename().string(), "real_time"};
  target.run = [=](const RunRequest& request) {
    Command words = {"--benchmark_repetitions=1", "--benchmark_min_time=0.05"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    if (!request.cases.empty()) words.push_back("--benchmark_filter=" + pattern_of(request.cases));
    words.insert(words.end(), {"--benchmark_out=" + file.string(), "--benchmark_out_format=json"});
    const Command command = command_of(programs, request.side, words);
    std::filesystem::remove(file);
    const baselines::ProcessResult ended = try_run(request, command, limits);
    std::map<std::string, double> seconds;
    for (const auto& [name, times] : times_of_benchmarks(file, ended, request.side, command))
      seconds[name] = bench::median(times);
    return seconds;
  };
  target.command = [=](Side side, const std::string& name) {
    Command words = arguments;
    std::erase_if(words, [](const std::string& word) { return word.starts_with("--benchmark_filter="); });
    words.push_back("--benchmark_filter=" + pattern_of({name}));
    return baselines::command_line(command_of(programs, side, words));
  };
  return target;
}

TimedTarget command_target(const Programs& programs, const std::vector<std::string>& arguments,
                           const baselines::Limits& limits) {
  const std::string name = arguments.empty() ? programs.head.filename().string() : baselines::command_line(arguments);
  TimedTarget target = {name, whole_process};
  target.run = [=](const RunRequest& request) -> std::map<std::string, double> {
    const Command command = command_of(programs, request.side, arguments);
    return {{name, run(request, command, limits).seconds}};
  };
  target.command = [=](Side side, const std::string&) {
    return baselines::command_line(command_of(programs, side, arguments));
  };
  return target;
}

}  // namespace ccdt::gate
