#include "bench/experiments/case_rows.h"

#include <algorithm>

#include "bench/results/kept_mesh.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::experiments {

cases::Case single_case(const ExperimentOptions& options, std::string name, std::string mesher,
                        const std::filesystem::path& input, std::vector<std::string> words) {
  return {.name = std::move(name),
          .group = {},
          .mesher = std::move(mesher),
          .input = input,
          .options = std::move(words),
          .limits = options.limits,
          .verify = true};
}

cases::Case timed_case(const ExperimentOptions& options, std::string group, const cases::Case& single, double until) {
  constexpr int most_runs = 60;
  cases::Case timed = single;
  timed.group = std::move(group);
  timed.repetitions = {1, options.runs, std::max(options.runs, most_runs), until};
  return timed;
}

std::vector<std::string> runs_of(const CaseRow& row) {
  return run_files(row.measured);
}

std::vector<double> samples_of(const CaseRow& row) {
  return row.ok() ? samples_of(row.measured, row.seconds) : std::vector<double>();
}

std::optional<Estimate> seconds_of(const CaseRow& row) {
  const std::vector<double> samples = samples_of(row);
  if (samples.empty()) return {};
  return bench::median_estimate(samples);
}

std::optional<Estimate> ratio_of(const CaseRow& above, const CaseRow& below) {
  const std::vector<double> a = samples_of(above), b = samples_of(below);
  if (a.empty() || b.empty() || std::ranges::min(b) <= 0) return {};
  return bench::ratio_of_medians(a, b);
}

std::string mesher_of(const CaseRow& row) {
  return baselines::mesher(row.measured.asked.mesher).name;
}

RowColumn<CaseRow> status_column() {
  return {label_column("status"), [](const CaseRow& row) { return name_of(row.measured.first.status); }};
}

RowColumn<CaseRow> reason_column() {
  return {note_column("reason"), [](const CaseRow& row) { return row.measured.first.reason; }};
}

RowColumn<CaseRow> seconds_column() {
  return {time_column("seconds", "", "s"), seconds_of};
}

RowColumn<CaseRow> count_column(std::string name, std::uint64_t MeshCounts::*count, std::string title) {
  return run_column(figure_column(std::move(name), std::move(title)),
                    [count](const RunRecord& run) { return as_cell(run.counts.*count); });
}

RowColumn<CaseRow> run_column(Column column, const std::function<Cell(const RunRecord&)>& figure) {
  return {std::move(column), [figure](const CaseRow& row) { return row.ok() ? figure(row.measured.first) : Cell(); }};
}

std::string failure(const cases::MeasuredCase& measured) {
  return std::string(name_of(measured.first.status)) + ": " + measured.first.reason;
}

void add_problem_of(const CaseRow& row, ExperimentResult& result) {
  const cases::Case& asked = row.measured.asked;
  if (!row.ok()) add_problem(result, asked.name + ": " + failure(row.measured), asked.mesher == "ccdt");
}

mesh::TetMesh mesh_of(const cases::Runner& runner, const cases::MeasuredCase& measured) {
  return io::read_tet_mesh(runner.settings().folder / mesh_file(measured));
}

KeptMesh keep_mesh(const cases::Runner& runner, const cases::MeasuredCase& measured, const std::string& title) {
  const std::string file = "meshes/" + measured.id + ".json";
  if (!std::filesystem::exists(runner.settings().folder / file))
    results::write_kept_mesh(mesh_of(runner, measured), title, runner.settings().folder / file);
  return {file, title, run_files(measured).front()};
}

}  // namespace ccdt::experiments
