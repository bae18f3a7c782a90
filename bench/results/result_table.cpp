#include "bench/results/result_table.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace ccdt::results {

std::size_t column_of(const ResultTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name, &Column::name);
  if (found == table.columns.end())
    throw std::out_of_range("table " + table.name + " has no column " + std::string(name));
  return static_cast<std::size_t>(found - table.columns.begin());
}

const Cell& cell(const ResultTable& table, const ResultRow& row, std::string_view column) {
  return row.cells.at(column_of(table, column));
}

std::string text_in(const ResultTable& table, const ResultRow& row, std::string_view column) {
  const auto* text = std::get_if<std::string>(&cell(table, row, column));
  return text ? *text : "";
}

double number_in(const ResultTable& table, const ResultRow& row, std::string_view column) {
  const Cell& value = cell(table, row, column);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* estimate = std::get_if<bench::Estimate>(&value)) return estimate->value;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ccdt::results
