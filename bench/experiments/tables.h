#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/results/result_table.h"

namespace ccdt::experiments {

/// A column of the given kind. Without a title, the title is the name with spaces.
inline results::Column column(results::ColumnKind kind, std::string name, std::string title = {},
                              std::string unit = {}) {
  if (title.empty()) {
    title = name;
    std::ranges::replace(title, '_', ' ');
  }
  return {std::move(name), std::move(title), kind, std::move(unit)};
}
inline results::Column label_column(std::string name, std::string title = {}) {
  return column(results::ColumnKind::label, std::move(name), std::move(title));
}
inline results::Column figure_column(std::string name, std::string title = {}, std::string unit = {}) {
  return column(results::ColumnKind::figure, std::move(name), std::move(title), std::move(unit));
}
inline results::Column time_column(std::string name, std::string title = {}, std::string unit = {}) {
  return column(results::ColumnKind::time, std::move(name), std::move(title), std::move(unit));
}
inline results::Column note_column(std::string name, std::string title = {}) {
  return column(results::ColumnKind::note, std::move(name), std::move(title));
}

template <class Items>
void append(std::vector<typename Items::value_type>& to, const Items& more) {
  to.insert(to.end(), more.begin(), more.end());
}

template <class Value>
results::Cell as_cell(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, results::Cell>)
    return value;
  else
    return results::cell_of(value);
}

/// Cells of any values: texts, numbers, estimates, yes or no, and those that may be missing.
template <class... Values>
std::vector<results::Cell> cells(const Values&... values) {
  return {as_cell(values)...};
}

/// Appends a row with a cell for each value.
///
/// \param runs  the files of the runs that the row stands on
template <class... Values>
void add_row(results::ResultTable& table, const std::vector<std::string>& runs, const Values&... values) {
  table.rows.push_back({cells(values...), runs});
}

}  // namespace ccdt::experiments
