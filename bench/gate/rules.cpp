#include "bench/gate/rules.h"

#include <fnmatch.h>

#include <algorithm>
#include <tuple>

#include "baselines/json_schema.h"
#include "bench/gate/rules_schema.h"
#include "bench/run/json_fields.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<gate::ExactRules> = std::tuple(optional_field("cases", &gate::ExactRules::cases),
                                                            optional_field("figures", &gate::ExactRules::figures),
                                                            optional_field("ignore", &gate::ExactRules::ignore),
                                                            optional_field("relative", &gate::ExactRules::relative));

template <>
inline constexpr auto fields<gate::InstructionRules> =
    std::tuple(optional_field("cases", &gate::InstructionRules::cases),
               optional_field("relative", &gate::InstructionRules::relative),
               optional_field("absolute", &gate::InstructionRules::absolute));

template <>
inline constexpr auto fields<gate::TimeRules> = std::tuple(
    optional_field("cases", &gate::TimeRules::cases), optional_field("figure", &gate::TimeRules::figure),
    optional_field("relative", &gate::TimeRules::relative),
    optional_field("absolute_seconds", &gate::TimeRules::absolute_seconds),
    optional_field("confidence", &gate::TimeRules::confidence),
    optional_field("largest_noise", &gate::TimeRules::largest_noise),
    optional_field("at_least", &gate::TimeRules::at_least), optional_field("at_most", &gate::TimeRules::at_most),
    optional_field("layouts", &gate::TimeRules::layouts),
    field_if_any("layout_deviation", &gate::TimeRules::layout_deviation));

}  // namespace ccdt::bench

namespace ccdt::gate {
namespace {

using bench::Json;

constexpr baselines::UserFile rules_file = {"the rules of a gate", rules_schema, "; `ccdt gate --help` has an example"};

bool is_like(const std::string& pattern, const std::string& name) {
  return pattern == name || fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// The better direction for the names of ccdt.run/1; the first match counts.
const std::vector<std::pair<std::string, Better>>& usual_directions() {
  static const std::vector<std::pair<std::string, Better>> all = {
      {"work.*", Better::fewer},
      {"counts.steiner_vertices", Better::fewer},
      {"counts.undelaunay_faces", Better::fewer},
      {"counts.front_tetrahedra", Better::fewer},
      {"counts.front_faces", Better::fewer},
      {"counts.segments.split", Better::fewer},
      {"counts.segments.pieces", Better::fewer},
      {"counts.segments.front", Better::fewer},
      {"counts.segments.delaunay", Better::more},
      {"counts.dropped_interior_vertices", Better::fewer},
      {"counts.improve.bad_cells_left", Better::fewer},
      {"quality.dihedral_degrees.min", Better::more},
      {"quality.*", Better::fewer},  // r, ratios and the largest angle
  };
  return all;
}

void read_time(const Json& json, TimeRules& time, const std::string& file, const std::string& pointer) {
  bench::read_fields(json, bench::fields<TimeRules>, time);
  if (time.at_most < time.at_least)
    baselines::fail_at_pointer(file, pointer + "/at_most", "this is fewer than at_least", "write a greater number");
}

ExactRules exact_from(const Json& json) {
  ExactRules exact;
  bench::read_fields(json, bench::fields<ExactRules>, exact);
  static const Json empty = Json::object();
  for (const auto& [pattern, share] : (json.contains("tolerances") ? json["tolerances"] : empty).items())
    exact.tolerances.emplace_back(pattern, share.get<double>());
  for (const auto& [pattern, better] : (json.contains("better") ? json["better"] : empty).items())
    exact.better.emplace_back(pattern, better.get<Better>());
  return exact;
}

}  // namespace

bool matches(const std::vector<std::string>& patterns, const std::string& name) {
  return std::ranges::any_of(patterns, [&](const std::string& pattern) { return is_like(pattern, name); });
}

bool is_gated(const Rules& rules, Layer layer, const std::string& case_name, const std::string& figure) {
  if (!rules.layers.contains(layer)) return false;
  if (layer == Layer::instructions) return matches(rules.instructions.cases, case_name);
  if (layer == Layer::time) return matches(rules.time.cases, case_name);
  return matches(rules.exact.cases, case_name) && matches(rules.exact.figures, figure) &&
         !matches(rules.exact.ignore, figure);
}

Better better_of(const ExactRules& rules, const std::string& figure) {
  for (const auto* directions : {&rules.better, &usual_directions()})
    for (const auto& [pattern, better] : *directions)
      if (is_like(pattern, figure)) return better;
  return Better::same;
}

bool has_rule(const ExactRules& rules, const std::string& figure) {
  const auto names = [&](const auto& rule) { return is_like(rule.first, figure); };
  return std::ranges::any_of(rules.tolerances, names) || std::ranges::any_of(rules.better, names);
}

double tolerance_of(const ExactRules& rules, const std::string& figure) {
  for (const auto& [pattern, share] : rules.tolerances)
    if (is_like(pattern, figure)) return share;
  return 0;
}

const TimeRules& time_rules_of(const Rules& rules, const std::string& case_name) {
  for (const CaseRules& special : rules.special)
    if (is_like(special.cases, case_name)) return special.time;
  return rules.time;
}

bench::Json to_json(const Rules& rules) {
  Json json = {{"schema", "ccdt.rules/1"}, {"layers", rules.layers}, {"shadow", rules.shadow}};
  json["exact"] = rules.exact;
  for (const auto& [pattern, share] : rules.exact.tolerances) json["exact"]["tolerances"][pattern] = share;
  for (const auto& [pattern, better] : rules.exact.better) json["exact"]["better"][pattern] = better;
  json["instructions"] = rules.instructions;
  json["time"] = rules.time;
  json["special"] = Json::array();
  for (const CaseRules& special : rules.special)
    json["special"].push_back({{"cases", special.cases}, {"time", special.time}});
  json["may_be_missing"] = rules.may_be_missing;
  return json;
}

Rules read_rules(const std::filesystem::path& file) {
  const Json json = baselines::read_user_file(file, rules_file);
  Rules rules;
  rules.layers_are_chosen = json.contains("layers");
  if (rules.layers_are_chosen) json["layers"].get_to(rules.layers);
  rules.shadow = json.value("shadow", rules.shadow);
  if (json.contains("may_be_missing")) json["may_be_missing"].get_to(rules.may_be_missing);
  rules.exact = exact_from(json.value("exact", Json::object()));
  bench::read_fields(json.value("instructions", Json::object()), bench::fields<InstructionRules>, rules.instructions);
  read_time(json.value("time", Json::object()), rules.time, file.string(), "/time");
  if (!json.contains("special")) return rules;
  for (std::size_t i = 0; i < json["special"].size(); ++i) {
    CaseRules special = {json["special"][i].at("cases").get<std::string>(), rules.time};
    read_time(json["special"][i].at("time"), special.time, file.string(), "/special/" + std::to_string(i) + "/time");
    rules.special.push_back(std::move(special));
  }
  return rules;
}

}  // namespace ccdt::gate
