#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/cases/runner.h"
#include "bench/sweep/expand.h"
#include "bench/sweep/spec.h"
#include "tools/error_words.h"

/// The parts of `ccdt sweep`.
namespace ccdt::tools {

/// How a sweep uses a cluster.
struct ClusterOptions {
  int chunk = -1;          ///< the one to run here; -1: none
  bool slurm = false;      ///< submit what is missing
  bool snakemake = false;  ///< write a Snakefile for what is missing
  double chunk_minutes = 30;
};

/// What the user has asked for.
struct SweepCommand {
  std::string spec, folder;
  std::filesystem::path program = {};  ///< the `ccdt` that is run; empty: this one
  std::vector<std::string> inputs;
  int jobs = 1;
  bool retry_failed = false, refresh = false, mixed = false;
  bool status = false, dry_run = false, json = false;
  ClusterOptions cluster = {};
};

/// A sweep whose folder is ready for runs: it has the models and an up-to-date sweep.json.
struct PreparedSweep {
  std::filesystem::path folder;  ///< absolute
  std::uint64_t seed = 1;
  std::vector<cases::Identity> identities = {};  ///< whose records count
  std::vector<sweep::SweepCase> cases = {};
};

/// Reads and expands the spec, writes the models and sweep.json, and prints what has changed since the last call.
///
/// \throw InputError   the spec is wrong, or the folder was made with other programs or on another machine
/// \throw OutputError  the folder cannot be written to
PreparedSweep prepare_sweep(const SweepCommand& command);

/// The cases of a prepared sweep as the records stand.
std::vector<cases::MeasuredCase> load_cases(const SweepCommand& command, const PreparedSweep& sweep);

/// Runs what is missing of these cases of the sweep, with a progress bar.
///
/// \throw baselines::Stopped  the user has stopped the program
/// \throw OutputError         a record cannot be written
std::vector<cases::MeasuredCase> run_cases(const SweepCommand& command, const PreparedSweep& sweep,
                                           std::span<const sweep::SweepCase> cases);

/// Prints how the cases ended, by mesher.
/// \return  what the program ends with: a failure of other meshers is a result, but of ours one that must not be
ExitCode print_results(std::span<const cases::MeasuredCase> cases);

/// What `ccdt mesh` accepts.
sweep::MeshOptionRules mesh_option_rules();

}  // namespace ccdt::tools
