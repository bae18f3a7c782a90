#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "baselines/process.h"
#include "bench/results/experiment_result.h"
#include "bench/statistics.h"

namespace ccdt {

/// What every experiment of `ccdt reproduce` is told.
struct ExperimentOptions {
  std::filesystem::path program;                     ///< the `ccdt` that is run
  std::filesystem::path folder;                      ///< models, meshes and records go here; exists
  int runs = 5;                                      ///< counted runs a case; one more before them is not counted
  double tetrahedra = 100000;                        ///< about how many a model is to get
  std::string scale = "paper";                       ///< as the user said it
  std::string command = {};                          ///< that repeats the experiment
  std::vector<std::string> models;                   ///< to measure; empty: all that the experiment has
  std::optional<std::vector<std::string>> beside;    ///< other meshers to measure; none: all of this build
  std::vector<std::filesystem::path> inputs;         ///< files in the folder to measure as well, if it takes files
  Limits limits{.seconds = 600, .memory_bytes = 0};  ///< of each run
};

/// Makes the folders of an experiment: models, meshes, runs.
/// \return  the circumstances, as they are before the first run
Circumstances start_experiment(const ExperimentOptions& options);

/// What an edge length that makes about 100,000 tetrahedra is to be multiplied with, to make as many as are wanted.
double edge_factor(const ExperimentOptions& options);

/// Has the user asked for this model?
bool is_asked_for(const ExperimentOptions& options, std::string_view model);

/// Does this build have the mesher, and has the user not left it out? Ours always takes part.
bool is_measured(const ExperimentOptions& options, std::string_view mesher);

/// The same where times are compared. Mesh_3 cannot mesh the paper's models with fewer tetrahedra than 50,000, however
/// long its edges may be, so it takes part only where that many are wanted.
bool is_timed(const ExperimentOptions& options, std::string_view mesher);

/// The meshers that the user has described by files, each the path of the file.
std::vector<std::string> described_meshers(const ExperimentOptions& options);

/// \throw InputError  there is nothing to measure, because none of the models that were asked for is part of it
void check_something_is_measured(std::size_t cases, std::string_view experiment);

/// What an interval says about a bound.
enum class Claim {
  holds,      ///< all of the interval is on the right side
  undecided,  ///< the bound is inside
  fails       ///< all of the interval is on the wrong side
};
Claim is_at_most(const Estimate& estimate, double bound);
Claim is_at_least(const Estimate& estimate, double bound);
std::string_view name_of(Claim claim);

}  // namespace ccdt
