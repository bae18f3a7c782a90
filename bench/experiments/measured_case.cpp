#include "bench/experiments/measured_case.h"

#include <algorithm>

#include "bench/results/kept_mesh.h"
#include "engine/io/tet_mesh_files.h"

namespace ccdt {

namespace {

std::string run_file(const MeasuredCase& measured, std::size_t number) {
  return "runs/" + measured.stem + "-" + std::to_string(number) + ".json";
}

}  // namespace

double long_run_seconds(const ExperimentOptions& options) {
  return options.tetrahedra / 10000;
}

bool is_counted(const ExperimentOptions& options, const MeasuredCase& measured, int number) {
  const bool is_long = measured.first.seconds.mesh > long_run_seconds(options);
  return number <= (is_long ? std::min(options.runs, counted_long_runs) : options.runs);
}

std::vector<std::string> run_files(const MeasuredCase& measured) {
  if (measured.failed() || measured.counted.empty()) return {run_file(measured, measured.first_run)};
  std::vector<std::string> files;
  for (std::size_t i = 1; i <= measured.counted.size(); ++i) files.push_back(run_file(measured, i));
  return files;
}

KeptMesh keep_mesh(const ExperimentOptions& options, const MeasuredCase& measured, const std::string& title) {
  const std::string file = "meshes/" + measured.stem + ".json";
  write_kept_mesh(read_tet_mesh(measured.what.output), title, options.folder / file);
  return {file, title, run_files(measured).front()};
}

void run_once(const ExperimentOptions& options, MeasuredCase& measured, int number) {
  if (measured.failed() || !is_counted(options, measured, number)) return;
  const auto report = options.folder / run_file(measured, static_cast<std::size_t>(number));
  RunRecord record = run_case(options.program, options.folder, measured.what, report, options.limits);
  if (number > 0 && record.status == RunStatus::ok) {
    measured.counted.push_back(record);
  } else {
    // A failure counts even if it went well before: a row of fewer samples than the others would not be fair.
    measured.first = record;
    measured.first_run = static_cast<std::size_t>(number);
  }
}

double cdt_seconds(const StageSeconds& s) {
  return s.delaunay + s.face_check + s.front + s.label;
}

}  // namespace ccdt
