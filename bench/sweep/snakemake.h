#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/sweep/chunks.h"

namespace ccdt::sweep {

/// The settings of the jobs in a Snakefile.
struct SnakemakeOptions {
  std::filesystem::path program;     ///< the `ccdt` that is run
  std::vector<std::string> options;  ///< more words of `ccdt sweep FOLDER --chunk N`, without spaces
  std::uint64_t memory_bytes = 0;    ///< limit of a run; 0: none
};

/// Writes FOLDER/Snakefile: one rule, with one job for each of these chunks, whose files exist. A chunk is done when
/// its marker exists (`chunk_marker`); older markers of these chunks are removed.
///
///     snakemake -s FOLDER/Snakefile --cores 2
///
/// \throw OutputError
void write_snakefile(const std::filesystem::path& folder, std::span<const Chunk> chunks,
                     const SnakemakeOptions& options);

}  // namespace ccdt::sweep
