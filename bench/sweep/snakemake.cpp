#include "bench/sweep/snakemake.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/run/json.h"
#include "bench/run/numbers.h"
#include "engine/io/files.h"

namespace ccdt::sweep {
namespace {

constexpr const char* snakemake_rules = R"(
workdir: workflow.basedir  # wherever the folder has been moved to, and wherever snakemake is called

rule all:
    input: expand("chunks/{number}.done", number=sorted(threads_of))

rule chunk:
    input: "chunks/{number}.json"
    output: touch("chunks/{number}.done")
    threads: lambda wildcards: threads_of[int(wildcards.number)]
    resources: **memory
    shell: "{program:q} sweep . --chunk {wildcards.number} {more_words}"
)";

/// A value in Python syntax, which is the same as JSON here.
std::string literal(const bench::Json& value) {
  return value.dump(-1, ' ', true, bench::Json::error_handler_t::replace);
}

}  // namespace

void write_snakefile(const std::filesystem::path& folder, std::span<const Chunk> chunks,
                     const SnakemakeOptions& options) {
  for (const Chunk& chunk : chunks) std::filesystem::remove(folder / chunk_marker(chunk.number));
  const auto megabytes = task_megabytes(options.memory_bytes);
  io::OutputFile file(folder / "Snakefile");
  file << "# Runs the missing cases of a sweep in chunks: snakemake -s Snakefile --cores 2\n"
       << "program = " << literal(std::filesystem::absolute(options.program).string()) << '\n'
       << "more_words = " << literal(bench::joined(options.options, " ")) << '\n'
       << "memory = {" << (megabytes > 0 ? "\"mem_mb\": " + std::to_string(megabytes) : "") << "}\n"
       << "threads_of = {";
  for (const Chunk& chunk : chunks)
    file << (&chunk == &chunks.front() ? "" : ", ") << chunk.number << ": " << chunk.threads;
  file << "}\n" << snakemake_rules;
  file.commit();
}

}  // namespace ccdt::sweep
