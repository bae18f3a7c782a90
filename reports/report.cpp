#include "reports/report.h"

#include <algorithm>

#include "bench/experiments/registry.h"
#include "bench/run_record.h"
#include "engine/base/errors.h"

namespace ccdt {
namespace {

std::string quoted_for_shell(const std::string& word) {
  const bool is_plain = !word.empty() && word.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                             "0123456789-_./=:,+@%") == std::string::npos;
  if (is_plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

/// The command, but for its results, which go to files of their own.
std::string repeating(std::vector<std::string> command) {
  for (std::size_t i = 0; i + 1 < command.size(); ++i) {
    const std::string ending = std::filesystem::path(command[i + 1]).extension().string();
    if (command[i] == "-o" || command[i] == "--report") command[i + 1] = "again" + ending;
  }
  std::string text;
  for (const std::string& word : command) text += (text.empty() ? "" : " ") + quoted_for_shell(word);
  return text;
}

RunLine run_line(const std::filesystem::path& file) {
  try {
    const RunRecord run = read_run_record(file);
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

ReportSection read_section(const std::filesystem::path& folder, const KnownExperiment& known) {
  ReportSection section;
  const auto file = folder / (known.name + ".json");
  try {
    if (std::filesystem::exists(file)) {
      section.result = read_experiment_result(file);
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

}  // namespace

void add_charts(std::span<const ReportChart> charts, ReportSection& section) {
  for (const ReportChart& chart : charts) {
    const bool has_tables = std::ranges::all_of(chart.tables, [&](const std::string& name) {
      const ResultTable* table = find_table(section.result, name);
      return table != nullptr && !table->rows.empty();
    });
    if (chart.experiment == section.result.name && has_tables) section.charts.push_back(chart);
  }
}

Report read_report(const std::filesystem::path& folder, std::span<const ReportChart> charts) {
  Report report;
  report.title = "Tetrahedral meshing by conforming constrained Delaunay tetrahedralization, measured again";
  for (const KnownExperiment& known : known_experiments()) {
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

}  // namespace ccdt
