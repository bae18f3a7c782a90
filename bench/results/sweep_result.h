#pragma once

#include <string>

#include "bench/results/experiment_result.h"
#include "bench/results/sweep_runs.h"

namespace ccdt::results {

/// The name of the result of a sweep, among those of the experiments.
inline constexpr const char* sweep_name = "sweep";

/// The result of a sweep, in the form of an experiment.
ExperimentResult sweep_result(const Sweep& sweep);

/// \name One line for each run, with the same flat columns in both: for pandas and R. Figures have all their digits.
/// @{
std::string runs_as_csv(const Sweep& sweep);
std::string runs_as_json_lines(const Sweep& sweep);
/// @}

/// The names of the columns of these files, for help texts.
std::string run_columns_help();

}  // namespace ccdt::results
