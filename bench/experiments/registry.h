#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "bench/cases/runner.h"
#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// An experiment that `ccdt reproduce` knows.
struct KnownExperiment {
  std::string name;
  std::string title;       ///< for people
  std::string section;     ///< of the paper
  std::string what;        ///< one line for people
  bool is_usual = true;    ///< done when none is named
  bool is_claimed = true;  ///< a claim of the paper is tested by it

  /// Measures what the records of the runner do not tell yet. The result has name, title and section of this entry.
  std::function<ExperimentResult(const ExperimentOptions&, cases::Runner&)> measure;
};

/// In the order in which reports show them.
std::span<const KnownExperiment> known_experiments();

/// Null if there is none of that name.
const KnownExperiment* known_experiment(std::string_view name);

}  // namespace ccdt::experiments
