#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bench/run/statistics.h"
#include "engine/base/enum_names.h"

namespace ccdt::results {

/// The kind of a column: how its values are shown, filtered and compared with other results.
enum class ColumnKind {
  label,   ///< labels of a row: model, mesher, strategy; texts
  figure,  ///< equal bit for bit in every repetition of a deterministic mesher; texts or numbers
  time,    ///< seconds and derived values; numbers, or estimates with their intervals
  paper,   ///< values from the paper; numbers
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
  std::vector<Cell> cells;             ///< one per column
  std::vector<std::string> runs = {};  ///< files of the runs behind the row, relative to the folder of the result
};

/// A table of results. Tables, charts and verdicts take their numbers from here alone.
struct ResultTable {
  std::string name;   ///< unique within the experiment
  std::string title;  ///< for people
  std::vector<Column> columns;
  std::vector<ResultRow> rows = {};
  bool is_data = false;  ///< for charts and programs: too long to be read by people
};

/// \throw std::out_of_range  there is no such column
std::size_t column_of(const ResultTable& table, std::string_view name);

/// The cell of a row; as a text (empty if it is none), or as a number (that of an estimate; NaN if it is none).
/// \throw std::out_of_range  there is no such column
const Cell& cell(const ResultTable& table, const ResultRow& row, std::string_view column);
std::string text_in(const ResultTable& table, const ResultRow& row, std::string_view column);
double number_in(const ResultTable& table, const ResultRow& row, std::string_view column);

}  // namespace ccdt::results
