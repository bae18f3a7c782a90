#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "bench/cases/case.h"
#include "bench/json.h"
#include "bench/sweep/slurm.h"
#include "tools/sweep_command.h"

/// `ccdt sweep` on a cluster: a sweep is cut into chunks, each of which a task runs by itself.
namespace ccdt::tools {

/// Adds --slurm, --snakemake, --chunk and --chunk-minutes to the verb.
void add_cluster_options(CLI::App& verb, ClusterOptions& options);

/// Runs what is missing of one chunk, as a task of a cluster does. It reads sweep.json, and changes nothing but
/// records. Tasks with the same chunk wait for each other: where a node's daemon has died, its tasks may be alive
/// still.
///
/// \throw InputError  there is no such chunk; or this machine or its programs are others than those of the sweep, and
///                    the command does not say --mixed
ExitCode run_chunk(const SweepCommand& command);

/// Cuts what is missing of a prepared sweep into chunks, and submits them to Slurm or writes a Snakefile. Prints what
/// it did.
void prepare_for_cluster(const SweepCommand& command, const PreparedSweep& sweep);

/// Where the chunks of a folder are. None if it has none, or if Slurm does not say; then that is printed.
///
/// \param cases  as the records stand
std::optional<sweep::ChunkCounts> chunk_status(const std::filesystem::path& folder,
                                               std::span<const cases::MeasuredCase> cases);

bench::Json to_json(const sweep::ChunkCounts& counts);

/// A line for people.
std::string in_words(const sweep::ChunkCounts& counts);

}  // namespace ccdt::tools
