#include "reports/report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/experiments/registry.h"
#include "bench/results/sweep_result.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::reports {
namespace {

/// The command, with new files for its results.
std::string repeating(std::vector<std::string> command) {
  for (std::size_t i = 0; i + 1 < command.size(); ++i) {
    const std::string ending = std::filesystem::path(command[i + 1]).extension().string();
    if (command[i] == "-o" || command[i] == "--report") command[i + 1] = "again" + ending;
  }
  return baselines::command_line(command);
}

RunLine run_line(const results::RunValues& run) {
  return {repeating(run.command), std::string(text_of(run, "status")), std::string(text_of(run, "mesher")),
          std::string(text_of(run, "version")), run.settings};
}

RunLine run_line(const std::filesystem::path& file) {
  const auto run = results::read_run_values(file);
  return run ? run_line(*run) : RunLine{"", "missing: " + file.string() + " cannot be read", "", "", {}};
}

/// Reads every run on which a section is based, once.
void add_runs(const std::filesystem::path& folder, const ReportSection& section, Report& report) {
  const auto add = [&](const std::string& file) {
    if (!file.empty() && !report.runs.contains(file)) report.runs[file] = run_line(folder / file);
  };
  for (const ResultTable& table : section.result.tables)
    for (const ResultRow& row : table.rows) std::ranges::for_each(row.runs, add);
  for (const KeptMesh& mesh : section.result.meshes) add(mesh.run);
}

/// The scale of the other experiments of the folder.
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

/// Why there are files of experiments that cannot be used; empty if there are none.
std::string unusable_files(const std::filesystem::path& folder, const Report& report) {
  std::string text;
  for (const ReportSection& section : report.sections)
    if (std::filesystem::exists(folder / (section.result.name + ".json"))) text += "\n  " + section.reason;
  return text;
}

/// Up to this many runs, a page contains the whole records.
constexpr std::size_t most_raw_runs = 3000;

std::string_view status_of(const ReportSection& section) {
  if (section.is_missing) return "missing";
  return section.result.is_good ? "ok" : "failed";
}

/// The experiments of the folder, and those that are missing.
void add_experiments(const std::filesystem::path& folder, std::span<const ReportChart> charts, Report& report) {
  for (const experiments::KnownExperiment& known : experiments::known_experiments()) {
    ReportSection section = read_section(folder, known);
    if (section.is_missing && !known.is_usual) continue;
    section.charts = charts_for(section.result, charts);
    add_runs(folder, section, report);
    report.sections.push_back(std::move(section));
  }
}

void add_claims(Report& report) {
  std::vector<ExperimentResult> results;
  for (ReportSection& section : report.sections) {
    if (section.is_missing)
      section.result.how.command =
          "ccdt reproduce " + section.result.name + " --scale " + usual_scale(report) + " -o .";
    else
      results.push_back(section.result);
  }
  report.claims = judge_claims(results);
}

void add_sweep(const std::filesystem::path& folder, std::span<const ReportChart> charts, Report& report) {
  const results::Sweep sweep = results::read_sweep(folder);
  ReportSection section;
  section.result = results::sweep_result(sweep);
  section.charts = charts_for(section.result, charts);
  for (const results::CaseRuns& one : sweep.cases)
    for (const results::NumberedRun& run : one.runs) report.runs[run.file] = run_line(run.values);
  if (report.sections.empty()) report.title = section.result.title;
  report.has_raw_runs = false;
  report.more_files = {{"runs.csv", runs_as_csv(sweep)}, {"runs.jsonl", runs_as_json_lines(sweep)}};
  report.sections.push_back(std::move(section));
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

Report read_report(const std::filesystem::path& folder, std::span<const ReportChart> charts) {
  io::check_links_stay_within(folder);
  Report report;
  report.title = "Tetrahedral meshing by conforming constrained Delaunay tetrahedralization: measurements";
  add_experiments(folder, charts, report);
  const bool has_sweep = std::filesystem::exists(sweep::sweep_file(folder));
  if (std::ranges::all_of(report.sections, &ReportSection::is_missing)) {
    if (!has_sweep)
      throw InputError("this folder contains neither an experiment nor a sweep" + unusable_files(folder, report),
                       {.file = folder.string()},
                       "fill one with `ccdt reproduce -o DIR` or `ccdt sweep SPEC.json -o DIR`");
    report.sections.clear();
  }
  if (!report.sections.empty()) add_claims(report);
  report.has_raw_runs = report.runs.size() <= most_raw_runs;
  if (has_sweep) add_sweep(folder, charts, report);
  return report;
}

bench::Json report_json(const Report& report) {
  return {{"schema", "ccdt.report/1"},      {"title", report.title}, {"claims", report.claims},
          {"experiments", report.sections}, {"runs", report.runs},   {"raw_runs", report.has_raw_runs}};
}

bench::Json claims_json(const Report& report) {
  return {{"schema", "ccdt.claims/1"}, {"claims", report.claims}};
}

}  // namespace ccdt::reports
