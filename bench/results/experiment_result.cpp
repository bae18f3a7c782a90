#include "bench/results/experiment_result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "bench/run/file_names.h"
#include "bench/run/json_fields.h"

namespace ccdt::bench {

template <>
inline constexpr auto fields<baselines::Limits> = std::tuple(field("seconds", &baselines::Limits::seconds),
                                                             field("memory_bytes", &baselines::Limits::memory_bytes));

template <>
inline constexpr auto fields<results::Column> = std::tuple(field("name", &results::Column::name),
                                                           field("title", &results::Column::title),
                                                           field("kind", &results::Column::kind),
                                                           field("unit", &results::Column::unit));

}  // namespace ccdt::bench

namespace ccdt::results {
namespace {

constexpr bench::DocumentKind experiment_document = {"ccdt.experiment/1",
                                                     "not an experiment of schema ccdt.experiment/1",
                                                     "give a folder that `ccdt reproduce` has filled"};

constexpr auto fields_of_mesh =
    std::tuple(bench::field("file", &KeptMesh::file), bench::field("title", &KeptMesh::title),
               bench::field("run", &KeptMesh::run), bench::field("figure", &KeptMesh::is_figure));

template <class Member>
constexpr auto circumstance(Member Circumstances::*member) {
  return [member](auto& result) -> auto& {
    return result.how.*member;
  };
}

constexpr auto fields_of_result = std::tuple(
    bench::field("name", &ExperimentResult::name), bench::field("title", &ExperimentResult::title),
    bench::field("section", &ExperimentResult::section), bench::field("command", circumstance(&Circumstances::command)),
    bench::field("scale", circumstance(&Circumstances::scale)),
    bench::field("tetrahedra", circumstance(&Circumstances::tetrahedra)),
    bench::field("runs", circumstance(&Circumstances::runs)),
    bench::field("confidence", circumstance(&Circumstances::confidence)),
    bench::field("limits", circumstance(&Circumstances::limits)), bench::field("good", &ExperimentResult::is_good),
    bench::field("definitions", &ExperimentResult::definitions), bench::field("findings", &ExperimentResult::findings),
    bench::field("problems", &ExperimentResult::problems), bench::field("tables", &ExperimentResult::tables),
    bench::field("meshes", &ExperimentResult::meshes), bench::field("raw_files", &ExperimentResult::raw_files),
    bench::field("environment", circumstance(&Circumstances::environment)));

bench::Json number_json(double value) {
  return std::isfinite(value) ? bench::Json(value) : bench::Json(nullptr);
}

/// Whole numbers without a fraction: 12, not 12.0.
bench::Json plain_number_json(double value) {
  constexpr double largest = 9007199254740992;  // beyond it doubles skip integers
  const bool is_whole = std::abs(value) < largest && value == std::floor(value);
  return is_whole ? bench::Json(static_cast<std::int64_t>(value)) : number_json(value);
}

Cell cell_from(const bench::Json& json) {
  if (json.is_null()) return {};
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number()) return json.get<double>();
  if (json.at("low").is_null()) return bench::without_interval(json.at("value"));
  return bench::Estimate{json.at("value"), json.at("low"), json.at("high")};
}

bench::Json json_of(const ExperimentResult& result) {
  bench::Json json = {{"schema", experiment_document.schema}};
  bench::write_fields(result, fields_of_result, json);
  return json;
}

/// The report writes files with these names, and reads the others.
void check_files_of(const ExperimentResult& result) {
  const auto check_run = [](const std::string& file) {
    if (!file.empty()) bench::check_file_path(file);
  };
  bench::check_file_name(result.name);
  for (const ResultTable& table : result.tables) {
    bench::check_file_name(table.name);
    for (const ResultRow& row : table.rows) std::ranges::for_each(row.runs, check_run);
  }
  for (const KeptMesh& mesh : result.meshes) {
    bench::check_file_path(mesh.file);
    check_run(mesh.run);
  }
  std::ranges::for_each(result.raw_files, bench::check_file_path);
}

ExperimentResult result_from(const bench::Json& json) {
  ExperimentResult result;
  bench::read_fields(json, fields_of_result, result);
  check_files_of(result);
  return result;
}

}  // namespace

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

const ResultTable* find_table(const ExperimentResult& result, std::string_view name) {
  const auto found = std::ranges::find(result.tables, name, &ResultTable::name);
  return found == result.tables.end() ? nullptr : &*found;
}

bench::Json cell_json(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return plain_number_json(*number);
  if (const auto* e = std::get_if<bench::Estimate>(&cell))
    return {{"value", number_json(e->value)}, {"low", number_json(e->low)}, {"high", number_json(e->high)}};
  return nullptr;
}

void to_json(bench::Json& json, const ResultTable& table) {
  json = {{"name", table.name}, {"title", table.title}, {"data", table.is_data}, {"columns", table.columns}};
  json["rows"] = bench::Json::array();
  for (const ResultRow& row : table.rows) {
    bench::Json values = bench::Json::object();
    for (std::size_t c = 0; c < table.columns.size(); ++c) values[table.columns[c].name] = cell_json(row.cells.at(c));
    json["rows"].push_back({{"values", std::move(values)}, {"runs", row.runs}});
  }
}

void from_json(const bench::Json& json, ResultTable& table) {
  table = {json.at("name"), json.at("title"), json.at("columns"), {}, json.at("data")};
  for (const bench::Json& r : json.at("rows")) {
    ResultRow row{{}, r.at("runs")};
    for (const Column& column : table.columns) row.cells.push_back(cell_from(r.at("values").at(column.name)));
    table.rows.push_back(std::move(row));
  }
}

void to_json(bench::Json& json, const KeptMesh& mesh) {
  bench::write_fields(mesh, fields_of_mesh, json);
}

void from_json(const bench::Json& json, KeptMesh& mesh) {
  bench::read_fields(json, fields_of_mesh, mesh);
}

std::string to_json(const ExperimentResult& result) {
  return bench::to_text(json_of(result));
}

ExperimentResult experiment_result_from_json(const std::string& text) {
  return bench::read_document(text, experiment_document, result_from);
}

void write_experiment_result(const ExperimentResult& result, const std::filesystem::path& folder) {
  bench::write_json(json_of(result), folder / (result.name + ".json"));
}

ExperimentResult read_experiment_result(const std::filesystem::path& file) {
  return bench::read_document(file, experiment_document, result_from);
}

}  // namespace ccdt::results
