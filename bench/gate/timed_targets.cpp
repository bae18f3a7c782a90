#include "bench/gate/timed_targets.h"

#include <nlohmann/json.hpp>

#include "bench/run/json.h"
#include "bench/run/run_case.h"
#include "bench/run/run_record.h"

namespace ccdt::gate {
namespace {

constexpr const char* whole_process = "wall";

/// "seconds.mesh" in the report of a run.
double figure_of(const std::filesystem::path& report, const std::string& figure) {
  double seconds = 0;
  bench::parse_document(report, bench::run_document,
                        [&](const bench::Json& json) { bench::value_at(json, figure).get_to(seconds); });
  return seconds;
}

Measured measured(const std::string& name, double seconds) {
  return {{name, {.seconds = seconds, .timed_seconds = seconds}}};
}

TimedTarget sweep_target(const Programs& programs, const bench::Case& asked, const Rules& rules,
                         const std::filesystem::path& folder) {
  const std::string figure = time_rules_of(rules, asked.name).figure;
  const auto report = folder / "timed.json";
  TimedTarget target = {asked.name, figure};
  target.run = [=](const RunRequest& request) {
    const Command command =
        command_of(programs, request, bench::mesh_arguments(folder, asked, "timed.mesh", "timed.json"));
    std::filesystem::remove(report);
    const baselines::ProcessResult result = run(request, command, asked.limits, folder);
    return measured(asked.name, figure == whole_process ? result.seconds : figure_of(report, figure));
  };
  target.command = [=](Side side, const std::string&) {
    return baselines::command_line(
        command_of(programs, {side}, bench::mesh_arguments(folder, asked, "again.mesh", "again.json")));
  };
  return target;
}

}  // namespace

std::vector<TimedTarget> sweep_targets(const Programs& programs, std::span<const bench::Case> cases, const Rules& rules,
                                       const std::filesystem::path& folder) {
  // In a separate folder without inputs, the commands contain the full paths of the inputs.
  const auto scratch = std::filesystem::absolute(folder) / "timed";
  std::filesystem::create_directories(scratch);
  std::vector<TimedTarget> targets;
  for (const bench::Case& asked : cases)
    if (is_gated(rules, Layer::time, asked.name, time_rules_of(rules, asked.name).figure))
      targets.push_back(sweep_target(programs, asked, rules, scratch));
  return targets;
}

TimedTarget command_target(const Programs& programs, const Command& arguments, const baselines::Limits& limits) {
  Command named = programs.head;
  named.insert(named.end(), arguments.begin(), arguments.end());
  const std::string name = short_name(named);
  TimedTarget target = {name, whole_process};
  target.run = [=](const RunRequest& request) {
    return measured(name, run(request, command_of(programs, request, arguments), limits).seconds);
  };
  target.command = [=](Side side, const std::string&) {
    return baselines::command_line(command_of(programs, {side}, arguments));
  };
  return target;
}

}  // namespace ccdt::gate
