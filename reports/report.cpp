#include "reports/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/experiments/registry.h"
#include "bench/run_record.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::reports {
namespace {

/// What all charts have in common; whoever draws them has it.
constexpr const char* shared_file = "config.json";

ReportChart read_chart(const std::filesystem::path& file) {
  try {
    const bench::Json json = bench::Json::parse(io::read_whole_file(file).bytes);
    return {json.at("experiment"), json.at("name"),   json.at("title"),
            json.at("caption"),    json.at("tables"), json.at("spec").dump()};
  } catch (const bench::Json::exception& error) {
    Place place;
    place.file = file.string();
    throw InputError(std::string("no chart: ") + error.what(), place, "build ccdt anew: its charts are broken");
  }
}

/// The command, but for its results, which go to files of their own.
std::string repeating(std::vector<std::string> command) {
  for (std::size_t i = 0; i + 1 < command.size(); ++i) {
    const std::string ending = std::filesystem::path(command[i + 1]).extension().string();
    if (command[i] == "-o" || command[i] == "--report") command[i + 1] = "again" + ending;
  }
  return experiments::command_line(command);
}

RunLine run_line(const std::filesystem::path& file) {
  try {
    const bench::RunRecord run = bench::read_run_record(file);
    return {repeating(run.command), std::string(name_of(run.status)), run.mesher.name, run.mesher.version,
            run.mesher_settings};
  } catch (const InputError& error) {
    return {"", std::string("missing: ") + error.what(), "", "", {}};
  }
}

/// Reads every run that a section stands on, once.
void add_runs(const std::filesystem::path& folder, const ReportSection& section, Report& report) {
  const auto add = [&](const std::string& file) {
    if (!file.empty() && !report.runs.contains(file)) report.runs[file] = run_line(folder / file);
  };
  for (const ResultTable& table : section.result.tables)
    for (const ResultRow& row : table.rows) std::ranges::for_each(row.runs, add);
  for (const KeptMesh& mesh : section.result.meshes) add(mesh.run);
}

/// The scale that the other experiments of the folder have.
std::string usual_scale(const Report& report) {
  for (const ReportSection& section : report.sections)
    if (!section.is_missing) return section.result.how.scale;
  return "quick";
}

ReportSection read_section(const std::filesystem::path& folder, const experiments::KnownExperiment& known) {
  ReportSection section;
  const auto file = folder / (known.name + ".json");
  try {
    if (std::filesystem::exists(file)) {
      section.result = results::read_experiment_result(file);
      return section;
    }
    section.reason = "There is no " + known.name + ".json in this folder.";
  } catch (const InputError& error) {
    section.reason = known.name + ".json cannot be used: " + error.what();
  }
  section.is_missing = true;
  section.result.name = known.name;
  section.result.title = known.title;
  section.result.section = known.section;
  return section;
}

std::string_view status_of(const ReportSection& section) {
  if (section.is_missing) return "missing";
  return section.result.is_good ? "ok" : "failed";
}

}  // namespace

/// \name The parts of a report as JSON.
/// @{
static void to_json(bench::Json& json, const ReportChart& chart) {
  json = {{"name", chart.name},
          {"title", chart.title},
          {"caption", chart.caption},
          {"tables", chart.tables},
          {"spec", bench::Json::parse(chart.spec)}};
}

static void to_json(bench::Json& json, const ClaimMeasure& m) {
  const bool is_open = m.strong == BoundTest::undecided;
  json = {{"what", m.what},
          {"value", results::cell_json(m.value)},
          {"bound", m.bound},
          {"holds", is_open ? bench::Json(nullptr) : bench::Json(m.strong == BoundTest::holds)},
          {"experiment", m.experiment},
          {"table", m.table},
          {"runs", m.runs}};
}

static void to_json(bench::Json& json, const PaperClaim& claim) {
  json = {{"id", claim.id},
          {"section", claim.section},
          {"sentence", claim.sentence},
          {"experiments", claim.experiments},
          {"measured", claim.measured},
          {"verdict", name_of(claim.verdict)},
          {"reason", claim.reason}};
}

static void to_json(bench::Json& json, const ReportSection& section) {
  const ExperimentResult& result = section.result;
  json = {{"name", result.name},
          {"title", result.title},
          {"section", result.section},
          {"status", status_of(section)},
          {"reason", section.reason},
          {"command", result.how.command},
          {"definitions", result.definitions},
          {"findings", result.findings},
          {"problems", result.problems},
          {"tables", result.tables},
          {"charts", section.charts},
          {"meshes", result.meshes},
          {"raw_files", result.raw_files}};
  if (section.is_missing) return;
  json["scale"] = result.how.scale;
  json["tetrahedra"] = result.how.tetrahedra;
  json["runs"] = result.how.runs;
  json["confidence"] = result.how.confidence;
  json["limits"] = {{"seconds", result.how.limits.seconds}, {"memory_bytes", result.how.limits.memory_bytes}};
  json["environment"] = result.how.environment;
}

static void to_json(bench::Json& json, const RunLine& run) {
  bench::Json settings = bench::Json::object();
  for (const auto& [name, words] : run.settings) settings[name] = words;
  json = {{"command", run.command},
          {"status", run.status},
          {"mesher", run.mesher},
          {"version", run.version},
          {"settings", settings}};
}
/// @}

std::vector<ReportChart> read_charts(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return {};
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json" && entry.path().filename() != shared_file) files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<ReportChart> charts;
  for (const auto& file : files) charts.push_back(read_chart(file));
  return charts;
}

void add_charts(std::span<const ReportChart> charts, ReportSection& section) {
  for (const ReportChart& chart : charts) {
    const bool has_tables = std::ranges::all_of(chart.tables, [&](const std::string& name) {
      const ResultTable* table = results::find_table(section.result, name);
      return table != nullptr && !table->rows.empty();
    });
    if (chart.experiment == section.result.name && has_tables) section.charts.push_back(chart);
  }
}

Report read_report(const std::filesystem::path& folder, std::span<const ReportChart> charts) {
  Report report;
  report.title = "Tetrahedral meshing by conforming constrained Delaunay tetrahedralization, measured again";
  for (const experiments::KnownExperiment& known : experiments::known_experiments()) {
    ReportSection section = read_section(folder, known);
    if (section.is_missing && !known.is_usual) continue;
    add_charts(charts, section);
    add_runs(folder, section, report);
    report.sections.push_back(std::move(section));
  }
  if (std::ranges::all_of(report.sections, &ReportSection::is_missing)) {
    Place place;
    place.file = folder.string();
    throw InputError("there is no experiment in this folder", place, "fill one with `ccdt reproduce -o DIR`");
  }
  std::vector<ExperimentResult> results;
  for (ReportSection& section : report.sections) {
    if (section.is_missing)
      section.result.how.command =
          "ccdt reproduce " + section.result.name + " --scale " + usual_scale(report) + " -o .";
    else
      results.push_back(section.result);
  }
  report.claims = judge_claims(results);
  return report;
}

bench::Json report_json(const Report& report) {
  return {{"schema", "ccdt.report/1"},
          {"title", report.title},
          {"claims", report.claims},
          {"experiments", report.sections},
          {"runs", report.runs}};
}

bench::Json claims_json(const Report& report) {
  return {{"schema", "ccdt.claims/1"}, {"claims", report.claims}};
}

}  // namespace ccdt::reports
