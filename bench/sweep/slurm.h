#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/sweep/chunks.h"

/// Sweeps on a cluster with Slurm. Only two of its programs are called, `sbatch` and `squeue`; results are collected
/// from files alone.
namespace ccdt::sweep {

/// How the chunks of a sweep are cut and run on a cluster.
struct SlurmOptions {
  std::filesystem::path program;     ///< the `ccdt` to run; every node finds it at this path
  std::vector<std::string> options;  ///< more words of `ccdt sweep FOLDER --chunk N`
  double chunk_seconds = 1800;       ///< target duration of a chunk
  std::uint64_t memory_bytes = 0;    ///< limit of a run; 0: none
  double seconds = 0;                ///< limit of a run; 0: none
};

/// The state of the chunks of a folder in Slurm; numbers of chunks.
struct SlurmQueue {
  std::set<int> queued, running;

  bool has(int chunk) const { return queued.contains(chunk) || running.contains(chunk); }
};

/// Have chunks of this folder been submitted to Slurm?
bool has_slurm_jobs(const std::filesystem::path& folder);

/// Asks Slurm which chunks of this folder are waiting or running.
///
/// \throw Error  Slurm does not answer
SlurmQueue ask_slurm(const std::filesystem::path& folder);

/// The jobs submitted by a call.
struct Submission {
  std::string job;                 ///< Slurm's number; empty: there was nothing to submit
  std::vector<Chunk> chunks = {};  ///< of this job
  SlurmQueue before = {};          ///< the chunks that were already waiting or running
};

/// Submits the missing cases that are neither waiting nor running to Slurm, as one job array. It can be called again
/// while jobs run, or after some of them died, but not twice at the same time.
///
/// Each submission is noted in slurm/jobs.json under a unique name beforehand, so that jobs are found again even if
/// this program is killed before Slurm answers.
///
/// \param missing  returns the missing cases; called after Slurm has answered, because a task may end at any time
/// \throw Error    Slurm is not installed, does not answer, or refuses; then nothing is submitted
Submission submit_to_slurm(const std::filesystem::path& folder, const SlurmOptions& options,
                           const std::function<std::vector<MissingCase>()>& missing);

/// The numbers of chunks by state. A case that is in several chunks counts in the newest one.
struct ChunkCounts {
  int finished = 0, queued = 0, running = 0, missing = 0;
};

/// \param missing_cases  their ids
ChunkCounts count_chunks(std::span<const Chunk> chunks, const SlurmQueue& queue,
                         const std::set<std::string>& missing_cases);

}  // namespace ccdt::sweep
