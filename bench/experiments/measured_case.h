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
  RunRecord first = {};  ///< of the run that is not counted, or of the one that failed
  bool failed() const { return first.status != RunStatus::ok; }
};

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
