#include "bench/gate/foreign_json.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "baselines/parse_json.h"
#include "baselines/process.h"
#include "bench/run/numbers.h"

namespace ccdt::gate {
namespace {

using bench::Json;

/// What Google Benchmark writes for numbers that JSON does not have, and what stands for them here.
constexpr auto not_in_json = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"-Infinity", "\"-Infinity\""}, {"Infinity", "\"Infinity\""}, {"-NaN", "\"NaN\""}, {"NaN", "\"NaN\""}});

double seconds_of_unit(const std::string& unit) {
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  return unit == "us" ? 1e-6 : 1e-9;
}

bool stands_for_a_number(const Json& value) {
  return value == "NaN" || value == "Infinity" || value == "-Infinity";
}

/// The members that Google Benchmark itself writes; all other numbers are counters of the benchmark. Its rates follow
/// from the time.
bool is_counter(const std::string& name, const Json& value) {
  static const std::set<std::string> own = {
      "name",      "run_name",         "run_type",     "label",       "error_message", "aggregate_name",
      "time_unit", "aggregate_unit",   "family_index", "repetitions", "threads",       "per_family_instance_index",
      "real_time", "repetition_index", "iterations",   "cpu_time"};
  return (value.is_number() || stands_for_a_number(value)) && !own.contains(name) && !name.ends_with("_per_second");
}

void add_sample(const std::string& name, Layer layer, const Json& value, CaseFigures& one) {
  Figure& known = figure_named(name, layer, one);
  if (value.is_number()) {
    known.samples.push_back(value.get<double>());
    return;
  }
  const auto text = value.get<std::string>();
  if (known.text.empty())
    known.text = text;
  else if (known.text != text)
    known.text += " or " + text;  // which is not equal to any other text
}

/// Programs older than 1.5 do not say which entries are aggregates.
bool is_aggregate(const Json& run) {
  if (run.contains("run_type")) return run["run_type"] == "aggregate";
  const auto name = run.at("name").get<std::string>();
  return name.ends_with("_mean") || name.ends_with("_median") || name.ends_with("_stddev") || name.ends_with("_cv");
}

bool is_median(const Json& run) {
  return run.value("aggregate_name", "") == "median" ||
         (!run.contains("aggregate_name") && run.at("name").get<std::string>().ends_with("_median"));
}

/// The name without "_median".
std::string name_of_run(const Json& run) {
  auto name = run.at("name").get<std::string>();
  if (!is_aggregate(run)) return name;
  return run.value("run_name", name.substr(0, name.rfind('_')));
}

std::string status_of(const Json& run) {
  if (run.value("error_occurred", false)) return "failed: " + run.value("error_message", "");
  return run.value("skipped", false) ? "skipped" : "ok";
}

void add_run(const Json& run, const std::string& program, Recording& recording) {
  const std::string name = name_of_run(run);
  CaseFigures& one = case_named(name, recording);
  if (!program.empty()) one.command = baselines::command_line({program, "--benchmark_filter=" + pattern_of({name})});
  const std::string status = status_of(run);
  if (find_figure(one, "status") == nullptr) one.figures.push_back({"status", Layer::exact, {}, status});
  if (status != "ok") return;
  const double unit = seconds_of_unit(run.value("time_unit", "ns"));
  for (const char* time : {"real_time", "cpu_time"})
    if (run.contains(time))
      add_sample(std::string("seconds.") + time, Layer::time, unit * run.at(time).get<double>(), one);
  const double together = unit * run.at("real_time").get<double>() * run.value("iterations", 1.0);
  one.timed_seconds = one.timed_seconds == 0 ? together : std::min(one.timed_seconds, together);
  for (const auto& [counter, value] : run.items())
    if (is_counter(counter, value)) add_sample(counter_prefix + counter, Layer::exact, value, one);
}

}  // namespace

std::string valid_json_of(const std::string& text) {
  std::string json;
  json.reserve(text.size());
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size();) {
    const auto number = std::ranges::find_if(not_in_json, [&](const auto& known) {
      return !is_quoted && text.compare(i, known.first.size(), known.first) == 0;
    });
    if (number != not_in_json.end()) {
      json += number->second;
      i += number->first.size();
      continue;
    }
    if (is_quoted && text[i] == '\\' && i + 1 < text.size())
      json += text[i++];
    else if (text[i] == '"')
      is_quoted = !is_quoted;
    json += text[i++];
  }
  return json;
}

Json parse_benchmark_json(const std::string& text) {
  return baselines::parse_json(valid_json_of(text));
}

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

bool is_google_benchmark(const Json& json) {
  return json.is_object() && json.contains("benchmarks") && json.contains("context") && json["benchmarks"].is_array();
}

void add_google_benchmark(const Json& json, Recording& recording) {
  std::string program;
  if (json.contains("context")) {
    for (const auto& [name, value] : json["context"].items())
      if (!value.is_structured())
        recording.identity["benchmark." + name] = value.is_string() ? value.get<std::string>() : value.dump();
    program = json["context"].value("executable", "");
  }
  const Json& runs = json.at("benchmarks");
  std::set<std::string> repeated;
  for (const Json& run : runs)
    if (!is_aggregate(run)) repeated.insert(run.value("run_name", name_of_run(run)));
  for (const Json& run : runs)
    if (!is_aggregate(run) || (is_median(run) && !repeated.contains(name_of_run(run))))
      add_run(run, program, recording);
}

bool is_hyperfine(const Json& json) {
  return json.is_object() && json.contains("results") && json["results"].is_array() && !json["results"].empty() &&
         json["results"][0].is_object() && json["results"][0].contains("command");
}

void add_hyperfine(const Json& json, Recording& recording) {
  for (const Json& result : json.at("results")) {
    CaseFigures one{result.at("command").get<std::string>(), result.at("command").get<std::string>(), {}};
    const auto same = std::ranges::count(recording.cases, one.name, &CaseFigures::name);
    if (same > 0) one.name += " (" + std::to_string(same + 1) + ")";
    Figure elapsed{"seconds.elapsed", Layer::time, {}};
    if (result.contains("times"))
      result["times"].get_to(elapsed.samples);
    else
      elapsed.samples = {result.at("median").get<double>()};
    one.figures.push_back(std::move(elapsed));
    std::set<int> codes;
    for (const Json& code : result.value("exit_codes", Json::array()))
      codes.insert(code.is_number() ? code.get<int>() : -1);
    std::vector<std::string> words;
    for (const int code : codes) words.push_back(std::to_string(code));
    if (!words.empty()) one.figures.push_back({"exit_codes", Layer::exact, {}, bench::joined(words)});
    add_case(std::move(one), recording);
  }
}

}  // namespace ccdt::gate
