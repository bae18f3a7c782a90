#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/results/result_table.h"

namespace ccdt::results {

/// A value as a cell: a text, a number, an estimate, yes or no, or one of these that may be missing.
template <class Value>
Cell as_cell(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, Cell>)
    return value;
  else
    return cell_of(value);
}

/// A column of the given kind. Without a title, the title is the name with spaces.
inline Column column(ColumnKind kind, std::string name, std::string title = {}, std::string unit = {}) {
  if (title.empty()) {
    title = name;
    std::ranges::replace(title, '_', ' ');
  }
  return {std::move(name), std::move(title), kind, std::move(unit)};
}
inline Column label_column(std::string name, std::string title = {}) {
  return column(ColumnKind::label, std::move(name), std::move(title));
}
inline Column figure_column(std::string name, std::string title = {}, std::string unit = {}) {
  return column(ColumnKind::figure, std::move(name), std::move(title), std::move(unit));
}
inline Column time_column(std::string name, std::string title = {}, std::string unit = {}) {
  return column(ColumnKind::time, std::move(name), std::move(title), std::move(unit));
}
inline Column note_column(std::string name, std::string title = {}) {
  return column(ColumnKind::note, std::move(name), std::move(title));
}

/// A column as data: its heading, and its cell as a function of the object of the row.
template <class Row>
struct RowColumn {
  /// \param value  a function of the row, or a pointer to a member of it; `as_cell` makes the value a cell
  template <std::invocable<const Row&> Value>
  RowColumn(Column heading, Value value)
      : column(std::move(heading)),
        cell([value = std::move(value)](const Row& row) { return as_cell(std::invoke(value, row)); }) {}

  /// A column of a base class is a column of a derived class.
  template <class Base>
  requires(std::derived_from<Row, Base> && !std::same_as<Row, Base>) RowColumn(const RowColumn<Base>& of_base)
      : column(of_base.column), cell(of_base.cell) {}

  Column column;
  std::function<Cell(const Row&)> cell;
};

template <class Row>
using RowColumns = std::vector<RowColumn<Row>>;

template <class Row>
std::vector<Column> headings(const RowColumns<Row>& columns) {
  std::vector<Column> all;
  for (const RowColumn<Row>& column : columns) all.push_back(column.column);
  return all;
}

template <class Row>
std::vector<Cell> cells_of(const RowColumns<Row>& columns, const Row& row) {
  std::vector<Cell> all;
  for (const RowColumn<Row>& column : columns) all.push_back(column.cell(row));
  return all;
}

/// A table with a row for each of `rows`. If there is a function `runs_of(row)`, it returns the files of the runs
/// behind the row.
template <class Row>
ResultTable table_of_rows(std::string name, std::string title, const RowColumns<Row>& columns,
                          std::ranges::range auto&& rows, bool is_data = false) {
  ResultTable table{std::move(name), std::move(title), headings(columns), {}, is_data};
  for (const Row& row : rows) {
    ResultRow& made = table.rows.emplace_back(ResultRow{cells_of(columns, row)});
    if constexpr (requires { runs_of(row); }) made.runs = runs_of(row);
  }
  return table;
}

/// A table without rows.
inline ResultTable table_of(std::string name, std::string title, std::vector<Column> columns, bool is_data = false) {
  return {std::move(name), std::move(title), std::move(columns), {}, is_data};
}

/// The value if it is known, otherwise an empty cell.
template <class Value>
Cell cell_if(bool is_known, const Value& value) {
  return is_known ? as_cell(value) : Cell();
}

/// Cells of any values: texts, numbers, estimates, yes or no, and those that may be missing.
template <class... Values>
std::vector<Cell> cells(const Values&... values) {
  return {as_cell(values)...};
}

/// Appends a row with a cell for each value.
///
/// \param runs  the files of the runs behind the row
template <class... Values>
void add_row(ResultTable& table, const std::vector<std::string>& runs, const Values&... values) {
  table.rows.push_back({cells(values...), runs});
}

/// A group of adjacent rows.
template <class Row, class Same>
std::vector<std::span<const Row>> neighbors(std::span<const Row> rows, Same belong_together) {
  std::vector<std::span<const Row>> groups;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && belong_together(rows[begin], rows[end])) ++end;
    groups.push_back(rows.subspan(begin, end - begin));
  }
  return groups;
}

}  // namespace ccdt::results
