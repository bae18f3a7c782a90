#include "bench/results/run_values.h"

#include <nlohmann/json.hpp>

#include "bench/run/run_record.h"
#include "engine/base/errors.h"

namespace ccdt::results {
namespace {

/// Nothing for what is missing or null, and for lists.
Cell cell_at(const bench::Json& run, std::string_view path) {
  const bench::Json& value = bench::value_at(run, path);
  if (value.is_boolean()) return cell_of(value.get<bool>());
  if (value.is_number()) return value.get<double>();
  return value.is_string() ? Cell(value.get<std::string>()) : Cell();
}

RunValues values_from(const bench::Json& json) {
  RunValues run;
  for (std::size_t i = 0; i < run_columns.size(); ++i) run.cells[i] = cell_at(json, run_columns[i].path);
  if (json.contains("command")) json["command"].get_to(run.command);
  for (const auto& [name, words] : bench::value_at(json, "options.mesher_settings").items())
    run.settings.emplace_back(name, words);
  return run;
}

}  // namespace

std::optional<double> number_of(const RunValues& run, RunField field) {
  const auto* number = std::get_if<double>(&run.cells[field.index]);
  return number == nullptr ? std::nullopt : std::optional(*number);
}

std::string_view text_of(const RunValues& run, RunField field) {
  const auto* text = std::get_if<std::string>(&run.cells[field.index]);
  return text == nullptr ? std::string_view() : *text;
}

std::optional<RunValues> read_run_values(const std::filesystem::path& file) {
  try {
    return bench::read_document(file, bench::run_document, values_from);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace ccdt::results
