#pragma once

#include <span>
#include <string>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// A mesher with a task, on some threads.
struct SpeedRow : CaseRow {
  std::string task, model;
  unsigned threads = 1;
  bool is_weak = false;  ///< the number of tetrahedra grows with the threads
};

/// Compares speed, memory and quality with other meshers, for the surface alone and end to end. The inputs are our
/// models of the paper's parts and the user's files. ccdt runs on 1, 2, 4, ... threads, also on models that grow with
/// the number of threads.
ExperimentResult measure_speed(const ExperimentOptions& options, bench::Runner& runner);

ExperimentResult speed_result(std::span<const SpeedRow> rows);

}  // namespace ccdt::experiments
