#include "reports/charts.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "bench/run/json.h"
#include "bench/run/numbers.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"
#include "reports/result_text.h"

namespace ccdt::reports {
namespace {

using results::Cell, results::Column, results::ColumnKind, results::ExperimentResult, results::ResultRow,
    results::ResultTable;

/// The configuration shared by all charts; the page and the program that draws figures have it.
constexpr const char* shared_file = "config.json";

ReportChart chart_from(const bench::Json& json) {
  ReportChart chart{json.at("experiment"), json.at("name"),   json.at("title"),
                    json.at("caption"),    json.at("tables"), json.at("spec").dump()};
  const bench::Json needs = json.value("needs", bench::Json::array());
  for (const bench::Json& need : needs) chart.needs.push_back({need.at("table"), need.at("column"), need.at("values")});
  chart.map_of = json.value("map_of", "");
  return chart;
}

ReportChart read_chart(const std::filesystem::path& file) {
  try {
    return chart_from(bench::Json::parse(io::read_whole_file(file).bytes));
  } catch (const bench::Json::exception& error) {
    Place place;
    place.file = file.string();
    throw InputError(std::string("not a chart: ") + error.what(), place, "build ccdt again: its charts are broken");
  }
}

/// Empty if there is nothing.
std::string value_text(const Cell& cell) {
  const bench::Json json = results::cell_json(cell);
  const bool is_nothing = json.is_null() || (json.is_string() && json.get_ref<const std::string&>().empty());
  return is_nothing ? "" : json.dump();
}

/// The number of different values of a column; a missing column has none.
std::size_t distinct_values(const ResultTable& table, std::size_t column) {
  std::set<std::string> values;
  for (const ResultRow& row : table.rows)
    if (std::string text = value_text(row.cells[column]); !text.empty()) values.insert(std::move(text));
  return values.size();
}

bool is_met(const ExperimentResult& result, const ChartNeed& need) {
  const ResultTable* table = results::find_table(result, need.table);
  if (table == nullptr) return false;
  const auto column = std::ranges::find(table->columns, need.column, &Column::name);
  return column != table->columns.end() &&
         distinct_values(*table, static_cast<std::size_t>(column - table->columns.begin())) >= need.values;
}

/// \name The axes of a table: label columns with several values, but not too many to be seen.
/// @{
constexpr std::size_t most_values = 16;
constexpr std::size_t most_pairs = 2;

struct Axis {
  const Column* column = nullptr;
  int rank = 0;  ///< importance: options that can be chosen come first
};

struct AxisPair {
  Axis first, second;
};

int rank_of(const Column& column) {
  if (column.name == "input" || column.name == "edge_length") return 1;
  if (column.name == "model") return 2;
  return column.name == "mesher" ? 3 : 4;
}

/// The name of an input contains its model and edge length.
bool names_input(const Column& column, const Column& axis) {
  const auto is_of_input = [](const Column& c) {
    return c.name == "input" || c.name == "model" || c.name == "edge_length";
  };
  return is_of_input(column) && is_of_input(axis);
}

/// Is the column a label of its row?
bool is_asked(const Column& column) {
  if (column.name == "status" || column.name == "failure") return false;
  return column.kind == ColumnKind::label || column.name == "edge_length";
}

/// Do rows that differ only in this axis differ in the value? Strategies, for example, do not change a mesh.
bool has_effect(const ResultTable& table, std::size_t axis, std::size_t of) {
  std::unordered_map<std::string, std::string> values;
  for (const ResultRow& row : table.rows) {
    const std::string value = value_text(row.cells[of]);
    if (value.empty()) continue;
    std::string others;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (c != axis && is_asked(table.columns[c]) && !names_input(table.columns[c], table.columns[axis]))
        others += value_text(row.cells[c]) + '\n';
    if (values.emplace(others, value).first->second != value) return true;
  }
  return false;
}

std::vector<Axis> axes_of(const ResultTable& table, const std::string& of) {
  std::vector<Axis> axes;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    if (!is_asked(column)) continue;
    const std::size_t values = distinct_values(table, c);
    if (values >= 2 && values <= most_values && has_effect(table, c, results::column_of(table, of)))
      axes.push_back({&column, rank_of(column)});
  }
  return axes;
}

/// In rows with both axes, both have several values, and at least half of their combinations exist.
bool is_worth_a_map(const ResultTable& table, const AxisPair& pair) {
  std::set<std::string> firsts, seconds;
  std::set<std::pair<std::string, std::string>> both;
  for (const ResultRow& row : table.rows) {
    const std::string first = value_text(results::cell(table, row, pair.first.column->name));
    const std::string second = value_text(results::cell(table, row, pair.second.column->name));
    if (first.empty() || second.empty()) continue;
    firsts.insert(first);
    seconds.insert(second);
    both.emplace(first, second);
  }
  return firsts.size() >= 2 && seconds.size() >= 2 && 2 * both.size() >= firsts.size() * seconds.size();
}

std::vector<AxisPair> axis_pairs(const ResultTable& table, const std::string& of) {
  const std::vector<Axis> axes = axes_of(table, of);
  std::vector<AxisPair> pairs;
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = i + 1; j < axes.size(); ++j)
      if (is_worth_a_map(table, {axes[i], axes[j]})) pairs.push_back({axes[i], axes[j]});
  std::ranges::stable_sort(pairs, std::greater(), [](const AxisPair& p) { return p.first.rank + p.second.rank; });
  if (pairs.size() > most_pairs) pairs.resize(most_pairs);
  return pairs;
}
/// @}

std::string replaced(std::string text, const std::string& place, const std::string& with) {
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + with.size()))
    text.replace(at, place.size(), with);
  return text;
}

/// The chart with the names of two axes filled in.
ReportChart made_for(ReportChart chart, const AxisPair& axes) {
  chart.name += "-" + axes.first.column->name + "-" + axes.second.column->name;
  for (const auto& [word, axis] : {std::pair("first", axes.first), std::pair("second", axes.second)})
    for (std::string* text : {&chart.name, &chart.title, &chart.caption, &chart.spec}) {
      *text = replaced(*text, std::string("{") + word + "}", axis.column->name);
      *text = replaced(*text, std::string("{") + word + " title}", heading(*axis.column));
    }
  return chart;
}

}  // namespace

std::vector<ReportChart> read_charts(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json" && entry.path().filename() != shared_file) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<ReportChart> charts;
  for (const auto& file : files) charts.push_back(read_chart(file));
  return charts;
}

std::vector<ReportChart> charts_for(const ExperimentResult& result, std::span<const ReportChart> charts) {
  std::vector<ReportChart> made;
  for (const ReportChart& chart : charts) {
    if (chart.experiment != result.name) continue;
    const bool has_tables = std::ranges::all_of(chart.tables, [&](const std::string& name) {
      const ResultTable* table = results::find_table(result, name);
      return table != nullptr && !table->rows.empty();
    });
    if (!has_tables || !std::ranges::all_of(chart.needs, [&](const ChartNeed& n) { return is_met(result, n); }))
      continue;
    if (chart.map_of.empty()) {
      made.push_back(chart);
      continue;
    }
    for (const AxisPair& pair : axis_pairs(*results::find_table(result, chart.tables.front()), chart.map_of))
      made.push_back(made_for(chart, pair));
  }
  return made;
}

}  // namespace ccdt::reports
