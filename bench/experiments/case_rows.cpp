#include "bench/experiments/case_rows.h"

#include <algorithm>

#include "bench/results/kept_mesh.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::experiments {
namespace {

constexpr int most_runs = 60;

/// What takes long is run less often. What is long depends on the scale: ten seconds with 100,000 tetrahedra a model.
double budget(const ExperimentOptions& options) {
  return options.tetrahedra / 10000;
}

}  // namespace

double cdt_seconds(const StageSeconds& s) {
  return s.delaunay + s.face_check + s.front + s.label;
}

double whole_seconds(const StageSeconds& s) {
  return s.mesh;
}

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

cases::Case timed_case(const ExperimentOptions& options, std::string group, const cases::Case& single, double until,
                       cases::SecondsOf seconds) {
  cases::Case timed = single;
  timed.group = std::move(group);
  timed.seconds = std::move(seconds);
  timed.repetitions = {.warm_up = 1,
                       .at_least = options.runs,
                       .at_most = std::max(options.runs, most_runs),
                       .until = until,
                       .budget_seconds = budget(options)};
  return timed;
}

std::string repetition_words(const ExperimentOptions& options, double until) {
  return "A case is repeated until the interval of its median is within " + rounded(100 * until, 1) + "% of it, " +
         std::to_string(options.runs) + " to " + std::to_string(std::max(options.runs, most_runs)) +
         " times; three are enough if they take " + rounded(budget(options), 2) + " s.";
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

bool is_ours(const CaseRow& row) {
  return row.measured.asked.mesher == "ccdt";
}

std::string mesher_of(const CaseRow& row) {
  return row.measured.first.mesher.name;
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
  if (!row.ok()) add_problem(result, row.measured.asked.name + ": " + failure(row.measured), is_ours(row));
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
