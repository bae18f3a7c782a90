#include "bench/results/experiment_result.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/json_parts.h"
#include "engine/base/errors.h"
#include "engine/io/file_bytes.h"
#include "engine/io/output_file.h"

namespace ccdt {
namespace {

constexpr const char* schema = "ccdt.experiment/1";

ColumnKind column_kind(const std::string& name) {
  for (const ColumnKind kind :
       {ColumnKind::label, ColumnKind::figure, ColumnKind::time, ColumnKind::paper, ColumnKind::note})
    if (name == name_of(kind)) return kind;
  throw std::invalid_argument("no kind of column: " + name);
}

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

ResultTable table_from(const Json& json) {
  ResultTable table{json.at("name"), json.at("title"), {}, {}, json.at("data")};
  for (const Json& c : json.at("columns"))
    table.columns.push_back({c.at("name"), c.at("title"), column_kind(c.at("kind")), c.at("unit")});
  for (const Json& r : json.at("rows")) {
    ResultRow row{{}, r.at("runs")};
    for (const Column& column : table.columns) row.cells.push_back(cell_from(r.at("values").at(column.name)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Circumstances circumstances_from(const Json& json) {
  return {.environment = environment_from_json(json.at("environment")),
          .runs = json.at("runs"),
          .confidence = json.at("confidence"),
          .limits = {json.at("limits").at("seconds"), json.at("limits").at("memory_bytes")},
          .tetrahedra = json.at("tetrahedra"),
          .scale = json.at("scale"),
          .command = json.at("command")};
}

ExperimentResult result_from(const Json& json) {
  ExperimentResult result{.name = json.at("name"),
                          .title = json.at("title"),
                          .section = json.at("section"),
                          .how = circumstances_from(json),
                          .definitions = json.at("definitions"),
                          .tables = {},
                          .findings = json.at("findings"),
                          .problems = json.at("problems"),
                          .meshes = {},
                          .raw_files = json.at("raw_files"),
                          .is_good = json.at("good")};
  for (const Json& table : json.at("tables")) result.tables.push_back(table_from(table));
  for (const Json& m : json.at("meshes"))
    result.meshes.push_back({m.at("file"), m.at("title"), m.at("run"), m.at("figure")});
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

Json table_json(const ResultTable& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const Column& c : table.columns)
    columns.push_back({{"name", c.name}, {"title", c.title}, {"kind", name_of(c.kind)}, {"unit", c.unit}});
  for (const ResultRow& row : table.rows) {
    Json values = Json::object();
    for (std::size_t c = 0; c < table.columns.size(); ++c) values[table.columns[c].name] = cell_json(row.cells.at(c));
    rows.push_back({{"values", std::move(values)}, {"runs", row.runs}});
  }
  return {{"name", table.name}, {"title", table.title}, {"data", table.is_data}, {"columns", columns}, {"rows", rows}};
}

Json kept_mesh_json(const KeptMesh& mesh) {
  return {{"file", mesh.file}, {"title", mesh.title}, {"run", mesh.run}, {"figure", mesh.is_figure}};
}

std::string to_json(const ExperimentResult& result) {
  Json json = {{"schema", schema},
               {"name", result.name},
               {"title", result.title},
               {"section", result.section},
               {"command", result.how.command},
               {"scale", result.how.scale},
               {"tetrahedra", result.how.tetrahedra},
               {"runs", result.how.runs},
               {"confidence", result.how.confidence},
               {"limits", {{"seconds", result.how.limits.seconds}, {"memory_bytes", result.how.limits.memory_bytes}}},
               {"good", result.is_good},
               {"definitions", result.definitions},
               {"findings", result.findings},
               {"problems", result.problems},
               {"tables", Json::array()},
               {"meshes", Json::array()},
               {"raw_files", result.raw_files},
               {"environment", environment_json(result.how.environment)}};
  for (const ResultTable& table : result.tables) json["tables"].push_back(table_json(table));
  for (const KeptMesh& mesh : result.meshes) json["meshes"].push_back(kept_mesh_json(mesh));
  return to_text(json);
}

ExperimentResult experiment_result_from_json(const std::string& text) {
  const std::string remedy = "give a folder that `ccdt reproduce` has filled";
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || json.value("schema", "") != schema)
      throw InputError("no experiment of schema ccdt.experiment/1", {}, remedy);
    return result_from(json);
  } catch (const std::exception& error) {
    if (dynamic_cast<const Error*>(&error) != nullptr) throw;
    throw InputError("no experiment of schema ccdt.experiment/1: " + std::string(error.what()), {}, remedy);
  }
}

void write_experiment_result(const ExperimentResult& result, const std::filesystem::path& folder) {
  io::OutputFile output(folder / (result.name + ".json"));
  output << to_json(result);
  output.commit();
}

ExperimentResult read_experiment_result(const std::filesystem::path& file) {
  try {
    return experiment_result_from_json(io::read_whole_file(file).bytes);
  } catch (InputError& error) {
    error.place().file = file.string();
    throw;
  }
}

}  // namespace ccdt
