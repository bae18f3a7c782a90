#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/statistics.h"
#include "engine/base/enum_names.h"

namespace ccdt::results {

/// What the values of a column are: how they are shown, filtered and compared with those of another time.
enum class ColumnKind {
  label,   ///< says what a row is of: model, mesher, strategy; texts
  figure,  ///< the same in every repetition, bit for bit, of meshers that repeat themselves; texts or numbers
  time,    ///< seconds and what is made of them; numbers, or estimates with their intervals
  paper,   ///< what the paper says; numbers
  note     ///< why a value is missing; texts
};

constexpr auto names_of(ColumnKind) {
  return std::to_array<NamedValue<ColumnKind>>({{ColumnKind::label, "label"},
                                                {ColumnKind::figure, "figure"},
                                                {ColumnKind::time, "time"},
                                                {ColumnKind::paper, "paper"},
                                                {ColumnKind::note, "note"}});
}

struct Column {
  std::string name;   ///< in JSON and CSV: letters, digits and underscores
  std::string title;  ///< for people
  ColumnKind kind = ColumnKind::figure;
  std::string unit = {};  ///< "s", "degrees"; empty: a number without one
};

/// Nothing, a text, a number, or a number with its interval.
using Cell = std::variant<std::monostate, std::string, double, bench::Estimate>;

/// \name A value as a cell.
/// @{
inline Cell cell_of(const std::optional<bench::Estimate>& estimate) {
  return estimate ? Cell(*estimate) : Cell();
}

inline Cell cell_of(const std::optional<double>& number) {
  return number ? Cell(*number) : Cell();
}

inline Cell cell_of(std::uint64_t count) {
  return static_cast<double>(count);
}

inline Cell cell_of(bool holds) {
  return std::string(holds ? "yes" : "no");
}

inline Cell cell_of(std::string_view text) {
  return std::string(text);
}
/// @}

struct ResultRow {
  std::vector<Cell> cells;             ///< one a column
  std::vector<std::string> runs = {};  ///< files with the runs that the row stands on, relative to the result's folder
};

/// What an experiment found, as a reader gets it. Tables, charts and verdicts take their numbers from here alone.
struct ResultTable {
  std::string name;   ///< unique within the experiment
  std::string title;  ///< for people
  std::vector<Column> columns;
  std::vector<ResultRow> rows = {};
  bool is_data = false;  ///< for charts and machines: too long to be read
};

/// \throw std::out_of_range  there is no such column
std::size_t column_of(const ResultTable& table, std::string_view name);

/// The cell of a row; as a text (empty if it is none), or as a number (that of an estimate; NaN if it is none).
/// \throw std::out_of_range  there is no such column
const Cell& cell(const ResultTable& table, const ResultRow& row, std::string_view column);
std::string text_in(const ResultTable& table, const ResultRow& row, std::string_view column);
double number_in(const ResultTable& table, const ResultRow& row, std::string_view column);

}  // namespace ccdt::results
