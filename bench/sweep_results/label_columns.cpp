#include <algorithm>
#include <array>

#include "bench/sweep_results/sweep_tables.h"

namespace ccdt::sweep_results {
namespace {

using results::Column;
using results::ColumnKind;

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

std::vector<Column> label_columns(const Sweep& sweep) {
  std::vector<Column> columns = {{"input", "input", ColumnKind::label},
                                 {"model", "model", ColumnKind::label},
                                 {"edge_length", "edge length", ColumnKind::figure, "mm"},
                                 {"mesher", "mesher", ColumnKind::label}};
  for (const std::string& option : sweep.options)
    columns.push_back({option_column(option), with_spaces(option), ColumnKind::label});
  return columns;
}

std::vector<results::Cell> label_cells(const CaseSummary& summary) {
  const SweepCase& of = *summary.of;
  std::vector<results::Cell> cells = {of.input, of.model, results::cell_of(of.edge_length), of.mesher};
  cells.insert(cells.end(), of.options.begin(), of.options.end());
  return cells;
}

}  // namespace ccdt::sweep_results
