#pragma once

#include <functional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/result_table.h"

namespace ccdt::results {

/// A column as data: its heading, and its cell as a function of what a row stands for.
template <class Row>
struct RowColumn {
  Column column;
  std::function<Cell(const Row&)> value;
};

/// A table with a row for each of `rows`, which have a member `runs`: the files of the runs that the row stands on.
template <class Row>
ResultTable table_of_rows(std::string name, std::string title, const std::vector<RowColumn<Row>>& columns,
                          const std::ranges::range auto& rows, bool is_data = false) {
  ResultTable table{std::move(name), std::move(title), {}, {}, is_data};
  for (const RowColumn<Row>& column : columns) table.columns.push_back(column.column);
  for (const Row& row : rows) {
    ResultRow& cells = table.rows.emplace_back();
    for (const RowColumn<Row>& column : columns) cells.cells.push_back(column.value(row));
    cells.runs = row.runs;
  }
  return table;
}

}  // namespace ccdt::results
