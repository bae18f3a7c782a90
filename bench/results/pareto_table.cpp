#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bench/results/sweep_tables.h"

namespace ccdt::results {
namespace {

/// A series is left out if it solves less than this share of the inputs; otherwise few inputs would remain for all.
constexpr double least_solved = 0.5;

/// The cases of one series, by their inputs.
using CasesByInput = std::map<std::string, const CaseSummary*>;

/// The data of one series in the chart.
struct Point {
  const CaseSummary* example = nullptr;
  std::vector<std::string> runs = {};
  double seconds = 0;  ///< geometric mean
  double worst_r = 0, mean_r = 0, min_dihedral = 180;
  bool is_on_front = true;
};

std::string family_of(const CaseRuns& one) {
  return one.input.model.empty() ? "files" : one.input.model;
}

/// The inputs that all series with enough of them have solved.
std::set<std::string> common_inputs(std::map<std::string, CasesByInput>& series, std::size_t inputs) {
  std::erase_if(series, [&](const auto& one) {
    return static_cast<double>(one.second.size()) < least_solved * static_cast<double>(inputs);
  });
  std::map<std::string, std::size_t> counts;
  for (const auto& [name, of_series] : series)
    for (const auto& [input, summary] : of_series) ++counts[input];
  std::set<std::string> common;
  for (const auto& [input, count] : counts)
    if (count == series.size()) common.insert(input);
  return common;
}

Point point_of(const CasesByInput& cases, const std::set<std::string>& inputs) {
  Point point;
  double logarithms = 0;
  for (const std::string& input : inputs) {
    const CaseSummary& s = *cases.at(input);
    point.example = &s;
    point.runs.insert(point.runs.end(), s.runs.begin(), s.runs.end());
    logarithms += std::log(s.seconds->value);
    point.worst_r = std::max(point.worst_r, number_of(s, "r_max").value_or(INFINITY));
    point.mean_r += number_of(s, "r_mean").value_or(INFINITY) / static_cast<double>(inputs.size());
    point.min_dihedral = std::min(point.min_dihedral, number_of(s, "dihedral_min").value_or(0));
  }
  point.seconds = std::exp(logarithms / static_cast<double>(inputs.size()));
  return point;
}

void find_front(std::map<std::string, Point>& points) {
  for (auto& [name, point] : points)
    point.is_on_front = std::ranges::none_of(points, [&p = point](const auto& other) {
      const Point& o = other.second;
      return o.seconds <= p.seconds && o.worst_r <= p.worst_r && (o.seconds < p.seconds || o.worst_r < p.worst_r);
    });
}

}  // namespace

ResultTable pareto_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  std::map<std::string, std::map<std::string, CasesByInput>> groups;
  std::map<std::string, std::set<std::string>> inputs;
  for (const CaseSummary& s : cases) {
    if (s.is_run()) inputs[family_of(*s.of)].insert(s.of->input.name);
    if (s.seconds && s.seconds->value > 0 && number_of(s, "r_max"))
      groups[family_of(*s.of)][s.series].emplace(s.of->input.name, &s);
  }
  ResultTable table{"pareto",
                    "Quality against time",
                    {{"group", "group", ColumnKind::label}, {"mesher", "mesher", ColumnKind::label}}};
  for (const std::string& option : sweep.options)
    table.columns.push_back({option_column(option), option, ColumnKind::label});
  const std::vector<Column> more = {{"legend", "series", ColumnKind::note},
                                    {"inputs", "inputs that all have solved", ColumnKind::time},
                                    {"seconds", "seconds, geometric mean", ColumnKind::time, "s"},
                                    {"worst_r", "worst r", ColumnKind::figure},
                                    {"mean_r", "mean r", ColumnKind::figure},
                                    {"min_dihedral", "smallest dihedral angle", ColumnKind::figure, "degrees"},
                                    {"front", "no other is faster and better", ColumnKind::time}};
  table.columns.insert(table.columns.end(), more.begin(), more.end());
  for (auto& [group, series] : groups) {
    const std::set<std::string> common = common_inputs(series, inputs[group].size());
    if (series.size() < 2 || common.empty()) continue;
    std::map<std::string, Point> points;
    for (const auto& [name, of_series] : series) points[name] = point_of(of_series, common);
    find_front(points);
    for (auto& [name, p] : points) {
      ResultRow& row = table.rows.emplace_back(ResultRow{{group, p.example->of->mesher}, std::move(p.runs)});
      row.cells.insert(row.cells.end(), p.example->of->values.begin(), p.example->of->values.end());
      row.cells.insert(row.cells.end(), {p.example->legend, static_cast<double>(common.size()), p.seconds, p.worst_r,
                                         p.mean_r, p.min_dihedral, cell_of(p.is_on_front)});
    }
  }
  return table;
}

}  // namespace ccdt::results
