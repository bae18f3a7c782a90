#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "bench/run/case.h"
#include "bench/run/json.h"
#include "bench/sweep/slurm.h"
#include "tools/sweep_command.h"

/// `ccdt sweep` on a cluster: a sweep is cut into chunks, and each task runs one of them.
namespace ccdt::tools {

/// Adds --slurm, --snakemake, --chunk and --chunk-minutes to the verb.
void add_cluster_options(CLI::App& verb, ClusterOptions& options);

/// Runs the missing cases of one chunk, as a task on a cluster does. It reads sweep.json and writes only records. Tasks
/// with the same chunk wait for each other, because a task may still be alive after the daemon of its node has died.
///
/// \throw InputError  there is no such chunk; or this machine or its programs differ from those of the sweep, without
/// --mixed
ExitCode run_chunk(const SweepCommand& command);

/// Cuts the missing cases of a prepared sweep into chunks, and submits them to Slurm or writes a Snakefile. Prints what
/// it did.
void prepare_for_cluster(const SweepCommand& command, const PreparedSweep& sweep);

/// The state of the chunks of a folder. None if it has none, or, with a message, if Slurm does not answer.
///
/// \param cases  as the records stand
std::optional<sweep::ChunkCounts> chunk_status(const std::filesystem::path& folder,
                                               std::span<const bench::MeasuredCase> cases);

bench::Json to_json(const sweep::ChunkCounts& counts);

/// The counts in one line.
std::string in_words(const sweep::ChunkCounts& counts);

}  // namespace ccdt::tools
