#include "bench/gate/baseline.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "baselines/json_schema.h"
#include "bench/gate/baseline_schema.h"
#include "bench/run/json_fields.h"
#include "bench/run/numbers.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<gate::BaselineUpdate> = std::tuple(
    field("date", &gate::BaselineUpdate::date), field("reason", &gate::BaselineUpdate::reason),
    field("revision", &gate::BaselineUpdate::revision), optional_field("changed", &gate::BaselineUpdate::changed),
    field("ratios", &gate::BaselineUpdate::ratios));

}  // namespace ccdt::bench

namespace ccdt::gate {
namespace {

using bench::Json;

constexpr baselines::UserFile baseline_file = {
    "a baseline", baseline_schema, "; or write a new one: `ccdt gate CURRENT --against FILE --update --reason TEXT`"};
constexpr const char* ungrouped = "mesh";      ///< the group of figures without one, such as "status"
constexpr std::size_t updates_of_a_trend = 3;  ///< updates in a row that make it worse
constexpr double largest_drift = 1.1;          ///< total loss of all updates

/// Sorted by name.
using Groups = std::map<std::string, std::map<std::string, Json>>;

/// "work.delaunay" and "walk_steps" of "work.delaunay.walk_steps".
std::pair<std::string, std::string> split_name(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {ungrouped, name};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

Json value_of(const Figure& figure) {
  if (figure.samples.empty()) return figure.text;
  const double value = bench::median(figure.samples);
  if (!std::isfinite(value)) return nullptr;
  constexpr double largest_exact = 9007199254740992.0;  // 2^53
  if (value == std::floor(value) && std::abs(value) <= largest_exact) return static_cast<std::int64_t>(value);
  return value;
}

Groups groups_of(const CaseFigures& one) {
  Groups groups;
  for (const Figure& figure : one.figures) {
    const auto [group, name] = split_name(figure.name);
    groups[group][name] = value_of(figure);
  }
  return groups;
}

CaseFigures case_from(const std::string& name, const Json& groups) {
  CaseFigures one{name, {}, {}};
  for (const auto& [group, figures] : groups.items())
    for (const auto& [leaf, value] : figures.items()) {
      Figure figure;
      if (group != ungrouped) figure.name = group + ".";
      figure.name += leaf;
      figure.layer = figure.name.starts_with("instructions.") ? Layer::instructions : Layer::exact;
      if (value.is_string())
        figure.text = value.get<std::string>();
      else
        figure.samples = {bench::number_from_json(value)};
      one.figures.push_back(std::move(figure));
    }
  return one;
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Items of a list or an object, one per line, with commas between them.
std::string in_lines(const std::vector<std::string>& items, const std::string& indent) {
  std::string text;
  for (const std::string& item : items) text.append(text.empty() ? "\n" : ",\n").append(indent).append(item);
  return text;
}

bool has_layer(const Recording& recording, Layer layer) {
  return std::ranges::any_of(recording.cases, [&](const CaseFigures& one) {
    return std::ranges::any_of(one.figures, [&](const Figure& figure) { return figure.layer == layer; });
  });
}

/// Adds the figures of a layer that the rules gate, or all if the rules leave out the layer.
void add_layer(const Recording& from, Layer layer, const Rules& rules, Recording& to) {
  const bool is_left_out = !rules.layers.contains(layer);
  for (const CaseFigures& one : from.cases)
    for (const Figure& figure : one.figures)
      if (figure.layer == layer && (is_left_out || is_gated(rules, layer, one.name, figure.name)))
        case_named(one.name, to).figures.push_back(figure);
  if (layer != Layer::instructions) return;
  for (const auto& [field, value] : from.identity)
    if (field.starts_with("instructions.")) to.identity[field] = value;
}

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm day{};
  gmtime_r(&now, &day);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d", &day)};
}

/// The ratio of new to old cost; 0 if there is none.
double cost_ratio(const JudgedFigure& figure, const Rules& rules) {
  if (!figure.changed || !figure.ratio || !(*figure.ratio > 0) || !std::isfinite(*figure.ratio)) return 0;
  const Better better = figure.layer == Layer::exact ? better_of(rules.exact, figure.name) : Better::fewer;
  if (better == Better::same) return 0;
  return better == Better::fewer ? *figure.ratio : 1 / *figure.ratio;
}

BaselineUpdate update_for(const std::vector<JudgedFigure>& figures, const Rules& rules, const Recording& head,
                          const std::string& reason) {
  BaselineUpdate update;
  update.date = today();
  update.reason = reason;
  const auto revision = head.identity.find("revision");
  if (revision != head.identity.end()) update.revision = revision->second;
  std::map<std::string, std::pair<double, int>> sums;
  for (const JudgedFigure& figure : figures) {
    update.changed += figure.changed ? 1 : 0;
    const double ratio = cost_ratio(figure, rules);
    if (ratio == 0) continue;
    auto& [sum, count] = sums[std::string(name_of(figure.layer))];
    sum += std::log(ratio);
    ++count;
  }
  for (const auto& [layer, sum] : sums) update.ratios[layer] = std::exp(sum.first / sum.second);
  return update;
}

std::string in_words(const BaselineUpdate& update, double ratio) {
  return update.date + " " + bench::rounded(100 * (ratio - 1), 2) + "% (" + update.reason + ")";
}

/// The updates that changed the cost of a layer, with their ratios.
using Changes = std::vector<std::pair<const BaselineUpdate*, double>>;

std::string note_on(const std::string& layer, const Changes& changes) {
  double together = 1;
  for (const auto& [update, ratio] : changes) together *= ratio;
  const auto better =
      std::ranges::find_if(changes.rbegin(), changes.rend(), [](const auto& c) { return c.second < 1; });
  const auto worse = static_cast<std::size_t>(better - changes.rbegin());
  if (worse < updates_of_a_trend && together <= largest_drift) return {};
  std::vector<std::string> reasons;
  for (const auto& [update, ratio] : changes)
    if (ratio > 1) reasons.push_back(in_words(*update, ratio));
  const std::string how =
      worse >= updates_of_a_trend
          ? "the last " + std::to_string(worse) + " updates of the baseline all made it worse"
          : "the updates of the baseline together made it " + bench::rounded(100 * (together - 1), 2) + "% worse";
  return layer + ": " + how + ": " + bench::joined(reasons, "; ");
}

}  // namespace

bool is_baseline(const Json& json) {
  return json.is_object() && json.contains("schema") && json["schema"] == "ccdt.baseline/1";
}

Baseline read_baseline(const std::filesystem::path& file) {
  const Json json = baselines::read_user_file(file, baseline_file);
  Baseline baseline;
  baseline.recording.source = file;
  baseline.recording.kind = Source::baseline;
  json.at("identity").get_to(baseline.recording.identity);
  try {
    for (const auto& [name, groups] : json.at("cases").items()) add_case(case_from(name, groups), baseline.recording);
  } catch (const std::invalid_argument& error) {
    throw InputError(error.what(), io::place_in(file.string()), "a baseline that `ccdt gate` wrote has fewer");
  }
  json.at("history").get_to(baseline.history);
  return baseline;
}

void write_baseline(const Baseline& baseline, const std::filesystem::path& file) {
  std::map<std::string, Groups> sorted;
  for (const CaseFigures& one : baseline.recording.cases) sorted[one.name] = groups_of(one);
  std::vector<std::string> cases, history;
  for (const auto& [name, groups] : sorted) {
    std::vector<std::string> lines;
    for (const auto& [group, figures] : groups) lines.push_back(line_of(group) + ": " + line_of(figures));
    cases.push_back(line_of(name) + ": {" + in_lines(lines, "      ") + "\n    }");
  }
  for (const BaselineUpdate& update : baseline.history) history.push_back(line_of(update));
  io::OutputFile output(file);
  output << "{\n  \"schema\": \"ccdt.baseline/1\",\n  \"identity\": " << line_of(baseline.recording.identity)
         << ",\n  \"cases\": {" << in_lines(cases, "    ") << "\n  },\n  \"history\": [" << in_lines(history, "    ")
         << "\n  ]\n}\n";
  output.commit();
}

Baseline updated(const Baseline& old, const Recording& head, const Rules& rules,
                 const std::vector<JudgedFigure>& figures, const std::string& reason) {
  Baseline anew;
  anew.recording.kind = Source::baseline;
  anew.history = old.history;
  anew.history.push_back(update_for(figures, rules, head, reason));
  for (const Layer layer : {Layer::exact, Layer::instructions})
    add_layer(rules.layers.contains(layer) && has_layer(head, layer) ? head : old.recording, layer, rules,
              anew.recording);
  return anew;
}

std::vector<std::string> history_notes(const std::vector<BaselineUpdate>& history) {
  std::map<std::string, Changes> by_layer;
  for (const BaselineUpdate& update : history)
    for (const auto& [layer, ratio] : update.ratios)
      if (ratio != 1) by_layer[layer].emplace_back(&update, ratio);
  std::vector<std::string> notes;
  for (const auto& [layer, changes] : by_layer)
    if (std::string note = note_on(layer, changes); !note.empty()) notes.push_back(std::move(note));
  return notes;
}

}  // namespace ccdt::gate
