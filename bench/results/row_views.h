#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/result_table.h"

namespace ccdt::results {

/// A row of a table with access to cells by the names of columns. The table must outlive it.
struct RowView {
  const ResultTable* table;
  const ResultRow* row;

  std::string text(std::string_view column) const { return text_in(*table, *row, column); }
  double number(std::string_view column) const { return number_in(*table, *row, column); }
  std::uint64_t count(std::string_view column) const { return static_cast<std::uint64_t>(number(column)); }
};
using RowViews = std::vector<RowView>;

/// The rows that have these texts in these columns.
inline RowViews rows_with(const ResultTable& table, const std::map<std::string, std::string>& texts = {}) {
  RowViews rows;
  for (const ResultRow& row : table.rows) {
    const RowView view{&table, &row};
    if (std::ranges::all_of(texts, [&](const auto& t) { return view.text(t.first) == t.second; })) rows.push_back(view);
  }
  return rows;
}

/// The sum of a column of counts.
inline std::uint64_t sum(const RowViews& rows, std::string_view column) {
  std::uint64_t total = 0;
  for (const RowView& row : rows) total += row.count(column);
  return total;
}

}  // namespace ccdt::results
