#pragma once

#include <functional>
#include <span>
#include <string>

#include "bench/experiments/experiment.h"

namespace ccdt {

/// An experiment that `ccdt reproduce` knows.
struct ReproducibleExperiment {
  std::string name;
  std::string what;  ///< one line for people
  std::string time;  ///< that it takes on two cores, for people

  /// Measures, writes NAME.json and NAME.md to the folder and prints the report. False if a run of our own failed, or
  /// gave what it must not; a baseline that fails is a row of the report and no more.
  std::function<bool(const ExperimentOptions&)> run;
};

std::span<const ReproducibleExperiment> reproducible_experiments();

}  // namespace ccdt
