#include "bench/gate/foreign_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "baselines/process.h"
#include "bench/results/numbers.h"

namespace ccdt::gate {
namespace {

using bench::Json;

double seconds_of_unit(const std::string& unit) {
  if (unit == "s") return 1;
  if (unit == "ms") return 1e-3;
  return unit == "us" ? 1e-6 : 1e-9;
}

/// The members that Google Benchmark itself writes; all other numbers are counters of the benchmark.
bool is_counter(const std::string& name, const Json& value) {
  static const std::set<std::string> own = {"family_index", "per_family_instance_index",
                                            "repetitions",  "repetition_index",
                                            "threads",      "iterations",
                                            "real_time",    "cpu_time"};
  return value.is_number() && !own.contains(name) && !name.ends_with("_per_second");
}

Figure& add_sample(const std::string& name, Layer layer, double value, CaseFigures& one) {
  const auto known = std::ranges::find(one.figures, name, &Figure::name);
  if (known == one.figures.end()) return one.figures.emplace_back(Figure{name, layer, {value}});
  known->samples.push_back(value);
  return *known;
}

/// Rates are hardly ever whole numbers, unless they are so large that all doubles are.
bool is_count(double value) {
  constexpr double most_exact = 9007199254740992.0;  // 2^53
  return value == std::floor(value) && std::abs(value) < most_exact;
}

/// Programs older than 1.5 do not say which entries are aggregates.
bool is_aggregate(const Json& run) {
  if (run.contains("run_type")) return run["run_type"] == "aggregate";
  const auto name = run.at("name").get<std::string>();
  return name.ends_with("_mean") || name.ends_with("_median") || name.ends_with("_stddev") || name.ends_with("_cv");
}

std::string status_of(const Json& run) {
  if (run.value("error_occurred", false)) return "failed: " + run.value("error_message", "");
  return run.value("skipped", false) ? "skipped" : "ok";
}

/// A benchmark's name as a regular expression that matches nothing else.
std::string filter_for(const std::string& name) {
  std::string text = "^";
  for (const char c : name)
    text += std::string("\\^$.|?*+()[]{}").find(c) == std::string::npos ? std::string(1, c) : std::string("\\") + c;
  return text + "$";
}

}  // namespace

bool is_google_benchmark(const Json& json) {
  return json.is_object() && json.contains("benchmarks") && json.contains("context") && json["benchmarks"].is_array();
}

void add_google_benchmark(const Json& json, Recording& recording) {
  for (const auto& [name, value] : json.at("context").items())
    if (!value.is_structured())
      recording.identity["benchmark." + name] = value.is_string() ? value.get<std::string>() : value.dump();
  const std::string program = json.at("context").value("executable", "");
  std::set<std::string> rates;
  for (const Json& run : json.at("benchmarks")) {
    if (is_aggregate(run)) continue;
    const auto name = run.at("name").get<std::string>();
    CaseFigures& one = case_named(name, recording);
    if (!program.empty()) one.command = baselines::command_line({program, "--benchmark_filter=" + filter_for(name)});
    const std::string status = status_of(run);
    if (find_figure(one, "status") == nullptr) one.figures.push_back({"status", Layer::exact, {}, status});
    if (status != "ok") continue;
    const double unit = seconds_of_unit(run.value("time_unit", "ns"));
    for (const char* time : {"real_time", "cpu_time"})
      add_sample(std::string("seconds.") + time, Layer::time, unit * run.at(time).get<double>(), one);
    for (const auto& [counter, value] : run.items()) {
      if (!is_counter(counter, value)) continue;
      const double number = value.get<double>();
      const bool is_rate = !is_count(number) || counter.ends_with("/s");
      Figure& figure = add_sample("counters." + counter, is_rate ? Layer::time : Layer::exact, number, one);
      if (is_rate) figure.layer = Layer::time;
      if (is_rate) rates.insert(counter);
    }
  }
  if (!rates.empty())
    recording.notes.push_back("counters that are not whole numbers count as rates and are not compared: " +
                              results::joined({rates.begin(), rates.end()}));
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
    if (!words.empty()) one.figures.push_back({"exit_codes", Layer::exact, {}, results::joined(words)});
    recording.cases.push_back(std::move(one));
  }
}

}  // namespace ccdt::gate
