#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/run/case.h"
#include "bench/run/identity.h"
#include "engine/base/progress.h"

namespace ccdt::bench {

/// Where and how cases are run.
struct RunnerSettings {
  std::filesystem::path program = {};     ///< the `ccdt` that is run
  std::filesystem::path folder = {};      ///< records go to its folder runs, kept meshes to meshes; exists
  std::vector<Identity> identities = {};  ///< whose records count; new ones are made with the first
  std::uint64_t seed = 1;                 ///< seed of the order in which repetitions take turns
  int jobs = 1;                           ///< number of simultaneous cases; more than one disturbs the times
  bool retry_failed = false;              ///< run cases again that failed earlier
  Progress progress = {};                 ///< counts runs
};

/// Runs cases, each run in a separate process. Nothing is run twice: existing records are read. So a caller that was
/// killed can be called again, and continues where it was.
///
/// Runs of one group take turns: each case once in a random order, then each once more. A failure is also a record, and
/// ends the repetitions of its case. A file that is not a record (truncated by a full disk, for example) counts as
/// missing.
class Runner {
 public:
  explicit Runner(RunnerSettings settings);

  const RunnerSettings& settings() const { return settings_; }

  /// Runs the missing runs of these cases, and returns all cases in the same order.
  ///
  /// \throw baselines::Stopped  the user has stopped the program; all finished runs have their records
  /// \throw OutputError         a record cannot be written
  std::vector<MeasuredCase> run(std::span<const Case> cases);

  /// The same for a single case.
  MeasuredCase run(const Case& asked);

  /// The names of the cases run so far whose times still spread more than requested after the largest number of
  /// repetitions.
  const std::set<std::string>& uncertain_cases() const { return uncertain_; }

  /// These cases with their existing records; runs nothing.
  std::vector<MeasuredCase> load(std::span<const Case> cases);

 private:
  RunnerSettings settings_;
  FileHashes hashes_;
  std::set<std::string> uncertain_;
  std::set<std::string> tried_;  ///< ids of the cases that were run here; they are not retried again
};

}  // namespace ccdt::bench
