#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/runner.h"
#include "bench/sweep/expand.h"
#include "bench/sweep/spec.h"
#include "tools/error_words.h"

/// The parts of `ccdt sweep`.
namespace ccdt::tools {

/// How a sweep uses a cluster.
struct ClusterOptions {
  int chunk = -1;          ///< number of the chunk to run here; -1: none
  bool slurm = false;      ///< submit the missing runs
  bool snakemake = false;  ///< write a Snakefile for the missing runs
  double chunk_minutes = 30;
};

/// The command line.
struct SweepCommand {
  std::string spec, folder;
  std::filesystem::path program = {};  ///< the `ccdt` to run; empty: this one
  std::vector<std::string> inputs;
  int jobs = 1;
  bool retry_failed = false, refresh = false, mixed = false;
  bool status = false, dry_run = false, json = false;
  ClusterOptions cluster = {};
};

/// A sweep whose folder is ready for runs: the models and sweep.json are up to date.
struct PreparedSweep {
  std::filesystem::path folder;  ///< absolute
  std::uint64_t seed = 1;
  std::vector<bench::Identity> identities = {};  ///< whose records count
  std::vector<sweep::SweepCase> cases = {};
};

/// Reads and expands the spec, writes the models and sweep.json, and prints what has changed since the last call.
///
/// \throw InputError   the spec is wrong, or the folder was made with other programs or on another machine
/// \throw OutputError  the folder cannot be written to
PreparedSweep prepare_sweep(const SweepCommand& command);

/// The cases of a prepared sweep with their current records.
std::vector<bench::MeasuredCase> load_cases(const SweepCommand& command, const PreparedSweep& sweep);

/// Runs those of these cases that have no record yet, with a progress bar.
///
/// \throw baselines::Stopped  the user has stopped the program
/// \throw OutputError         a record cannot be written
std::vector<bench::MeasuredCase> run_cases(const SweepCommand& command, const PreparedSweep& sweep,
                                           std::span<const sweep::SweepCase> cases);

/// Prints for each mesher how its cases ended.
/// \return  the exit code: a failure of another mesher is a result, a failure of ccdt is an error
ExitCode print_results(std::span<const bench::MeasuredCase> cases);

/// The options that `ccdt mesh` accepts.
sweep::MeshOptionRules mesh_option_rules();

}  // namespace ccdt::tools
