#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "bench/experiments/experiment.h"
#include "bench/run/runner.h"

namespace ccdt::experiments {

/// An experiment that `ccdt reproduce` knows.
struct KnownExperiment {
  std::string name;
  std::string title;       ///< for people
  std::string section;     ///< of the paper
  std::string what;        ///< one line for people
  bool is_usual = true;    ///< runs when none is named
  bool is_claimed = true;  ///< tests a claim of the paper

  /// Measures what the records of the runner do not contain yet. The result has the name, title and section of this
  /// entry.
  std::function<ExperimentResult(const ExperimentOptions&, bench::Runner&)> measure;
};

/// All experiments, in the order of reports.
std::span<const KnownExperiment> known_experiments();

}  // namespace ccdt::experiments
