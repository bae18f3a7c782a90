#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/results/csv_text.h"
#include "bench/results/row_columns.h"
#include "bench/results/sweep_result.h"
#include "bench/run/file_names.h"
#include "bench/run/numbers.h"
#include "engine/base/digits.h"

namespace ccdt::results {
namespace {

/// The columns before those of the record: the data of the sweep.
constexpr auto case_columns = std::to_array<std::string_view>(
    {"case", "number", "counted", "file", "name", "input", "input_file", "model", "edge_length"});

/// All values of a run, in the order of `names_of`.
std::vector<Cell> values_of(const Sweep& sweep, const CaseRuns& of, const NumberedRun& run) {
  std::vector<Cell> values = {of.id,
                              static_cast<double>(run.number),
                              std::string(run.number >= of.asked.repetitions.warm_up ? "yes" : "no"),
                              run.file,
                              of.asked.name,
                              of.input.name,
                              bench::name_in(sweep.folder, of.input.file),
                              of.input.model,
                              cell_if(!of.input.model.empty(), of.input.edge_length)};
  values.insert(values.end(), run.values.cells.begin(), run.values.cells.end());
  values.insert(values.end(), of.values.begin(), of.values.end());
  return values;
}

std::vector<std::string> names_of(const Sweep& sweep) {
  std::vector<std::string> names(case_columns.begin(), case_columns.end());
  for (const RunColumn& column : run_columns) names.emplace_back(column.name);
  for (std::string option : sweep.options) {
    std::ranges::replace(option, '-', '_');
    names.push_back("option_" + option);
  }
  return names;
}

std::string csv_cell(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return digits(*number);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : csv_text(*text);
}

}  // namespace

std::string runs_as_csv(const Sweep& sweep) {
  std::vector<std::string> names = names_of(sweep);
  std::ranges::transform(names, names.begin(), csv_text);
  std::string text = bench::joined(names, ",") + "\r\n";
  for (const CaseRuns& of : sweep.cases)
    for (const NumberedRun& run : of.runs) {
      const std::vector<Cell> values = values_of(sweep, of, run);
      for (std::size_t i = 0; i < values.size(); ++i) text.append(i == 0 ? "" : ",").append(csv_cell(values[i]));
      text += "\r\n";
    }
  return text;
}

std::string runs_as_json_lines(const Sweep& sweep) {
  const std::vector<std::string> names = names_of(sweep);
  std::string text;
  for (const CaseRuns& of : sweep.cases)
    for (const NumberedRun& run : of.runs) {
      const std::vector<Cell> values = values_of(sweep, of, run);
      bench::Json line = bench::Json::object();
      for (std::size_t i = 0; i < values.size(); ++i)
        line[names[i]] = values[i] == Cell(std::string()) ? bench::Json() : cell_json(values[i]);
      text += line.dump(-1, ' ', false, bench::Json::error_handler_t::replace) + "\n";
    }
  return text;
}

std::string run_columns_help() {
  std::string text;
  for (const std::string_view name : case_columns) text.append(name).append(" ");
  for (const RunColumn& column : run_columns) text.append(column.name).append(" ");
  return text + "option_NAME";
}

}  // namespace ccdt::results
