#include "bench/results/case_rows.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "bench/results/kept_mesh.h"
#include "bench/run/median_interval.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt::results {

double cdt_seconds(const StageCosts& costs) {
  double sum = 0;
  for (const Stage stage : {Stage::delaunay, Stage::face_check, Stage::front, Stage::label})
    sum += costs[stage].seconds;
  return sum;
}

double whole_seconds(const StageCosts& costs) {
  return costs.mesh_seconds;
}

SecondsOf stage_seconds(Stage stage) {
  return [stage](const StageCosts& costs) { return costs[stage].seconds; };
}

std::vector<std::string> runs_of(const CaseRow& row) {
  return run_files(row.measured);
}

std::vector<double> samples_of(const CaseRow& row) {
  return row.ok() ? samples_of(row.measured, row.seconds) : std::vector<double>();
}

std::optional<Estimate> seconds_of(const CaseRow& row) {
  if (samples_of(row).empty()) return {};
  return median_of(row.measured, row.seconds);
}

std::optional<Estimate> ratio_of(const CaseRow& above, const CaseRow& below) {
  const std::vector<double> a = samples_of(above), b = samples_of(below);
  if (a.empty() || b.empty() || std::ranges::min(b) <= 0) return {};
  const MeasuredCase& shorter = a.size() < b.size() ? above.measured : below.measured;
  return bench::median_ratio(a, b, looks_of(shorter.asked.repetitions));
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

std::string failure(const MeasuredCase& measured) {
  return std::string(name_of(measured.first.status)) + ": " + measured.first.reason;
}

mesh::TetMesh mesh_of(const Runner& runner, const MeasuredCase& measured) {
  return io::read_tet_mesh(runner.settings().folder / mesh_file(measured));
}

KeptMesh keep_mesh(const Runner& runner, const MeasuredCase& measured, const std::string& title) {
  const std::string file = "meshes/" + measured.id + ".json";
  if (!std::filesystem::exists(runner.settings().folder / file))
    write_kept_mesh(mesh_of(runner, measured), title, runner.settings().folder / file);
  return {file, title, run_files(measured).front()};
}

}  // namespace ccdt::results
