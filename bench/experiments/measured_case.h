#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/experiments/case_runner.h"
#include "bench/experiments/experiment.h"

namespace ccdt {

/// A case with all that its runs have told.
struct MeasuredCase {
  std::string name;  ///< within its group
  std::string stem;  ///< of the names of its records: "piston-with_check"
  Case what;
  std::vector<RunRecord> counted = {};
  RunRecord first = {};       ///< of the run that is not counted, or of the one that failed
  std::size_t first_run = 0;  ///< the number of that run
  bool failed() const { return first.status != RunStatus::ok; }
};

/// Cases of which a run takes long are counted only so often. What is long depends on the scale: a second with 10,000
/// tetrahedra a model.
inline constexpr int counted_long_runs = 3;
double long_run_seconds(const ExperimentOptions& options);

/// Is the run of this number still to be made, now that the case has been run once?
bool is_counted(const ExperimentOptions& options, const MeasuredCase& measured, int number);

/// The files of the runs that a row of this case stands on, relative to the folder: the counted ones, or the one that
/// failed.
std::vector<std::string> run_files(const MeasuredCase& measured);

/// Keeps the mesh that the case has just made, for pictures: in meshes/STEM.json.
/// \pre it has not failed, and its mesh is still there
/// \throw OutputError
KeptMesh keep_mesh(const ExperimentOptions& options, const MeasuredCase& measured, const std::string& title);

/// Runs a case once, unless it has failed before; run 0 is not counted. Its record goes to runs/STEM-NUMBER.json.
/// \throw OutputError  the record cannot be written
void run_once(const ExperimentOptions& options, MeasuredCase& measured, int number);

/// Seconds of the constrained Delaunay tetrahedralization of given vertices, the paper's CDT times: Delaunay, face
/// check, front and labelling.
double cdt_seconds(const StageSeconds& seconds);

/// One number of each counted run.
template <class Seconds>
std::vector<double> samples_of(std::span<const RunRecord> runs, Seconds seconds) {
  std::vector<double> samples;
  samples.reserve(runs.size());
  for (const RunRecord& run : runs) samples.push_back(seconds(run.seconds));
  return samples;
}

}  // namespace ccdt
