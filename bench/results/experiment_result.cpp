#include "bench/results/experiment_result.h"

#include <algorithm>
#include <cmath>

#include "bench/json_fields.h"

namespace ccdt {

template <>
inline constexpr auto fields<Limits> = std::tuple(field("seconds", &Limits::seconds),
                                                  field("memory_bytes", &Limits::memory_bytes));

template <>
inline constexpr auto fields<Column> = std::tuple(field("name", &Column::name), field("title", &Column::title),
                                                  field("kind", &Column::kind), field("unit", &Column::unit));

namespace {

constexpr DocumentKind experiment_document = {"ccdt.experiment/1", "no experiment of schema ccdt.experiment/1",
                                              "give a folder that `ccdt reproduce` has filled"};

constexpr auto fields_of_mesh = std::tuple(field("file", &KeptMesh::file), field("title", &KeptMesh::title),
                                           field("run", &KeptMesh::run), field("figure", &KeptMesh::is_figure));

template <class Member>
constexpr auto circumstance(Member Circumstances::*member) {
  return [member](auto& result) -> auto& {
    return result.how.*member;
  };
}

constexpr auto fields_of_result = std::tuple(
    field("name", &ExperimentResult::name), field("title", &ExperimentResult::title),
    field("section", &ExperimentResult::section), field("command", circumstance(&Circumstances::command)),
    field("scale", circumstance(&Circumstances::scale)), field("tetrahedra", circumstance(&Circumstances::tetrahedra)),
    field("runs", circumstance(&Circumstances::runs)), field("confidence", circumstance(&Circumstances::confidence)),
    field("limits", circumstance(&Circumstances::limits)), field("good", &ExperimentResult::is_good),
    field("definitions", &ExperimentResult::definitions), field("findings", &ExperimentResult::findings),
    field("problems", &ExperimentResult::problems), field("tables", &ExperimentResult::tables),
    field("meshes", &ExperimentResult::meshes), field("raw_files", &ExperimentResult::raw_files),
    field("environment", circumstance(&Circumstances::environment)));

Json number_json(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Whole numbers as such: 12, not 12.0.
Json plain_number_json(double value) {
  constexpr double largest = 9007199254740992;  // beyond it doubles skip integers
  const bool is_whole = std::abs(value) < largest && value == std::floor(value);
  return is_whole ? Json(static_cast<std::int64_t>(value)) : number_json(value);
}

Cell cell_from(const Json& json) {
  if (json.is_null()) return {};
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number()) return json.get<double>();
  return Estimate{json.at("value"), json.at("low"), json.at("high")};
}

Json json_of(const ExperimentResult& result) {
  Json json = {{"schema", experiment_document.schema}};
  write_fields(result, fields_of_result, json);
  return json;
}

ExperimentResult result_from(const Json& json) {
  ExperimentResult result;
  read_fields(json, fields_of_result, result);
  return result;
}

}  // namespace

const ResultTable* find_table(const ExperimentResult& result, std::string_view name) {
  const auto found = std::ranges::find(result.tables, name, &ResultTable::name);
  return found == result.tables.end() ? nullptr : &*found;
}

Json cell_json(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return plain_number_json(*number);
  if (const auto* e = std::get_if<Estimate>(&cell))
    return {{"value", number_json(e->value)}, {"low", number_json(e->low)}, {"high", number_json(e->high)}};
  return nullptr;
}

void to_json(Json& json, const ResultTable& table) {
  json = {{"name", table.name}, {"title", table.title}, {"data", table.is_data}, {"columns", table.columns}};
  json["rows"] = Json::array();
  for (const ResultRow& row : table.rows) {
    Json values = Json::object();
    for (std::size_t c = 0; c < table.columns.size(); ++c) values[table.columns[c].name] = cell_json(row.cells.at(c));
    json["rows"].push_back({{"values", std::move(values)}, {"runs", row.runs}});
  }
}

void from_json(const Json& json, ResultTable& table) {
  table = {json.at("name"), json.at("title"), json.at("columns"), {}, json.at("data")};
  for (const Json& r : json.at("rows")) {
    ResultRow row{{}, r.at("runs")};
    for (const Column& column : table.columns) row.cells.push_back(cell_from(r.at("values").at(column.name)));
    table.rows.push_back(std::move(row));
  }
}

void to_json(Json& json, const KeptMesh& mesh) {
  write_fields(mesh, fields_of_mesh, json);
}

void from_json(const Json& json, KeptMesh& mesh) {
  read_fields(json, fields_of_mesh, mesh);
}

std::string to_json(const ExperimentResult& result) {
  return to_text(json_of(result));
}

ExperimentResult experiment_result_from_json(const std::string& text) {
  return read_document(text, experiment_document, result_from);
}

void write_experiment_result(const ExperimentResult& result, const std::filesystem::path& folder) {
  write_json(json_of(result), folder / (result.name + ".json"));
}

ExperimentResult read_experiment_result(const std::filesystem::path& file) {
  return read_document(file, experiment_document, result_from);
}

}  // namespace ccdt
