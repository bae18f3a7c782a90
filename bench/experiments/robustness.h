#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// One mesher on one part of a corpus.
struct RobustnessRow : CaseRow {
  std::string part;    ///< the file, relative to the corpus
  std::string input;   ///< "valid", "not valid" or "unreadable", as the manifest of the corpus says
  std::string mesher;  ///< its name; "ccdt --repair" repairs first
  bool repairs = false;
  std::optional<double> extent = {};  ///< the largest of the part's, in its units, if it was repaired
};

/// Runs ccdt without and with repair, TetGen, Mesh_3, HXT and described meshers on every part of a corpus, once, and
/// verifies every mesh.
///
/// \throw InputError  no corpus is given, or its manifest cannot be read
ExperimentResult measure_robustness(const ExperimentOptions& options, bench::Runner& runner);

ExperimentResult robustness_result(std::span<const RobustnessRow> rows);

}  // namespace ccdt::experiments
