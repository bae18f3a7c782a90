#include <algorithm>
#include <array>
#include <iterator>

#include "bench/results/sweep_tables.h"

namespace ccdt::results {
namespace {

/// Options of these names would be mistaken for columns of every sweep.
constexpr auto taken = std::to_array<std::string_view>(
    {"input", "model", "edge_length", "mesher", "status", "failure", "reason", "seconds", "vertices", "tetrahedra"});

std::string with_spaces(std::string text) {
  std::ranges::replace(text, '-', ' ');
  return text;
}

}  // namespace

std::string option_column(const std::string& option) {
  std::string name = option;
  std::ranges::replace(name, '-', '_');
  return std::ranges::find(taken, name) == taken.end() ? name : "option_" + name;
}

RowColumns<CaseSummary> label_columns(const Sweep& sweep) {
  RowColumns<CaseSummary> columns = {
      {label_column("input"), [](const CaseSummary& s) { return s.of->input.name; }},
      {label_column("model"), [](const CaseSummary& s) { return s.of->input.model; }},
      {figure_column("edge_length", "", "mm"),
       [](const CaseSummary& s) { return cell_if(!s.of->input.model.empty(), s.of->input.edge_length); }},
      {label_column("mesher"), [](const CaseSummary& s) { return s.of->mesher; }}};
  for (std::size_t i = 0; i < sweep.options.size(); ++i)
    columns.emplace_back(label_column(option_column(sweep.options[i]), with_spaces(sweep.options[i])),
                         [i](const CaseSummary& s) { return s.of->values[i]; });
  return columns;
}

ResultTable labeled_table(const Sweep& sweep, std::string name, std::string title, std::vector<Column> more,
                          bool is_data) {
  ResultTable table = table_of(std::move(name), std::move(title), headings(label_columns(sweep)), is_data);
  std::ranges::move(more, std::back_inserter(table.columns));
  return table;
}

void add_labeled_row(ResultTable& table, std::vector<std::string> runs, std::vector<Cell> labels,
                     std::vector<Cell> more) {
  std::ranges::move(more, std::back_inserter(labels));
  table.rows.push_back({std::move(labels), std::move(runs)});
}

}  // namespace ccdt::results
