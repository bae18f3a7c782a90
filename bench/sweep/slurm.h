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
  std::filesystem::path program;     ///< the `ccdt` that is run; every node finds it there
  std::vector<std::string> options;  ///< more words of `ccdt sweep FOLDER --chunk N`
  double chunk_seconds = 1800;       ///< what a chunk is worth
  std::uint64_t memory_bytes = 0;    ///< limit of a run; 0: none
  double seconds = 0;                ///< limit of a run; 0: none
};

/// Where Slurm has the chunks of a folder; numbers of chunks.
struct SlurmQueue {
  std::set<int> queued, running;

  bool has(int chunk) const { return queued.contains(chunk) || running.contains(chunk); }
};

/// Have chunks of this folder been given to Slurm?
bool has_slurm_jobs(const std::filesystem::path& folder);

/// Asks Slurm for the chunks of this folder that wait or run.
///
/// \throw Error  Slurm cannot be asked, so nobody knows
SlurmQueue ask_slurm(const std::filesystem::path& folder);

/// What a call has given to Slurm.
struct Submission {
  std::string job;                 ///< Slurm's number; empty: there was nothing to submit
  std::vector<Chunk> chunks = {};  ///< of this job
  SlurmQueue before = {};          ///< what was waiting or running already
};

/// Gives the missing cases that no task waits for or runs to Slurm, as one job array. So it can be called again while
/// jobs run, or after some of them have died, but not twice at the same time.
///
/// What is submitted is noted in slurm/jobs.json under a name of its own before it is, so that jobs are found again
/// even if this program is killed before Slurm has answered.
///
/// \param missing  says what is missing; called after Slurm has been asked, since a task may end at any time
/// \throw Error    Slurm is not installed, does not answer, or refuses; then nothing is submitted
Submission submit_to_slurm(const std::filesystem::path& folder, const SlurmOptions& options,
                           const std::function<std::vector<MissingCase>()>& missing);

/// How many chunks are where. A case that is in several chunks counts in the newest.
struct ChunkCounts {
  int finished = 0, queued = 0, running = 0, missing = 0;
};

/// \param missing_cases  their ids
ChunkCounts count_chunks(std::span<const Chunk> chunks, const SlurmQueue& queue,
                         const std::set<std::string>& missing_cases);

}  // namespace ccdt::sweep
