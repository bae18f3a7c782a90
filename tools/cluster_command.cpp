#include "tools/cluster_command.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/run/numbers.h"
#include "bench/sweep/chunks.h"
#include "bench/sweep/estimate.h"
#include "bench/sweep/slurm.h"
#include "bench/sweep/snakemake.h"
#include "bench/sweep/sweep_document.h"
#include "engine/base/errors.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

/// A task names only the folder; a user may name the spec and the folder.
std::filesystem::path folder_of(const SweepCommand& command) {
  const bool has_folder = !command.folder.empty();
  return std::filesystem::absolute(has_folder ? command.folder : command.spec).lexically_normal();
}

std::vector<std::string> meshers_of(const std::vector<sweep::SweepCase>& cases) {
  std::set<std::string> meshers;
  for (const sweep::SweepCase& c : cases) meshers.insert(c.asked.mesher);
  return {meshers.begin(), meshers.end()};
}

/// The cases of the chunk.
std::vector<sweep::SweepCase> cases_of(const sweep::Chunk& chunk, const std::vector<sweep::SweepCase>& all) {
  const std::set<std::string> wanted(chunk.cases.begin(), chunk.cases.end());
  std::vector<sweep::SweepCase> cases;
  for (const sweep::SweepCase& c : all)
    if (wanted.contains(c.id)) cases.push_back(c);
  return cases;
}

int threads_of(const sweep::SweepCase& c) {
  int threads = 1;
  for (const auto& [name, value] : c.options)
    if (name == "threads") std::from_chars(value.data(), value.data() + value.size(), threads);
  return threads;
}

std::vector<sweep::MissingCase> missing_cases(const SweepCommand& command, const PreparedSweep& sweep) {
  const std::vector<bench::MeasuredCase> loaded = load_cases(command, sweep);
  const std::vector<sweep::CaseEstimate> estimates = sweep::estimate_cases(sweep.cases, loaded);
  std::vector<sweep::MissingCase> missing;
  for (std::size_t i = 0; i < loaded.size(); ++i)
    if (bench::needs_run(loaded[i]))
      missing.push_back({.id = loaded[i].id,
                         .group = loaded[i].asked.group,
                         .seconds = estimates[i].missing_seconds(),
                         .threads = threads_of(sweep.cases[i])});
  return missing;
}

/// The options of the tasks besides the number of their chunk.
std::vector<std::string> options_of_tasks(const SweepCommand& command) {
  std::vector<std::string> words;
  if (command.mixed) words.push_back("--mixed");
  if (command.retry_failed) words.push_back("--retry-failed");
  if (command.jobs > 1) words.insert(words.end(), {"--jobs", std::to_string(command.jobs)});
  return words;
}

std::string count_of(std::size_t count, const char* one, const char* many) {
  return bench::with_separators(count) + " " + (count == 1 ? one : many);
}

void print_submission(const sweep::Submission& submission) {
  const auto running = submission.before.running.size(), queued = submission.before.queued.size();
  if (running + queued > 0)
    print(count_of(running, "chunk is", "chunks are") + " running, " + count_of(queued, "is", "are") +
          " in Slurm's queue\n");
  if (!submission.job.empty())
    print("submitted " + count_of(submission.chunks.size(), "chunk", "chunks") + " as job " + submission.job + "\n");
  else
    print("nothing to submit\n");
}

}  // namespace

void add_cluster_options(CLI::App& verb, ClusterOptions& options) {
  auto* slurm = verb.add_flag(
      "--slurm", options.slurm,
      "submit the missing runs to Slurm as one job array; call it again to see the progress and to resubmit lost runs");
  verb.add_flag("--snakemake", options.snakemake, "write DIR/Snakefile for the missing runs")->excludes(slurm);
  verb.add_option("--chunk-minutes", options.chunk_minutes, "target duration of a Slurm or Snakemake task, in minutes")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_option("--chunk", options.chunk, "run only the cases of DIR/chunks/NUMBER.json, as a task does")
      ->check(CLI::NonNegativeNumber);
}

ExitCode run_chunk(const SweepCommand& command) {
  PreparedSweep sweep{folder_of(command)};
  const sweep::SweepDocument document = sweep::read_sweep(sweep.folder);
  const sweep::Chunk chunk = sweep::read_chunk(sweep.folder, command.cluster.chunk);
  sweep.seed = document.seed;
  sweep.identities = bench::accepted_identities(
      sweep::sweep_file(sweep.folder), bench::identity_of(meshers_of(document.cases), own_program()),
      command.mixed ? bench::OtherIdentity::mixed : bench::OtherIdentity::refuse);
  sweep.cases = cases_of(chunk, document.cases);
  const sweep::ChunkLock lock(sweep.folder, chunk.number);
  print_results(run_cases(command, sweep, sweep.cases));
  return done;  // failures are results; a task that ends with an error counts as lost
}

void prepare_for_cluster(const SweepCommand& command, const PreparedSweep& sweep) {
  const auto missing = [&] { return missing_cases(command, sweep); };
  const baselines::Limits limits = sweep.cases.empty() ? baselines::Limits{} : sweep.cases.front().asked.limits;
  const double chunk_seconds = command.cluster.chunk_minutes * 60;
  if (command.cluster.slurm) {
    print_submission(sweep::submit_to_slurm(sweep.folder,
                                            {.program = own_program(),
                                             .options = options_of_tasks(command),
                                             .chunk_seconds = chunk_seconds,
                                             .memory_bytes = limits.memory_bytes,
                                             .seconds = limits.seconds},
                                            missing));
    return;
  }
  std::vector<sweep::Chunk> chunks = sweep::cut_into_chunks(missing(), chunk_seconds);
  sweep::write_chunks(sweep.folder, chunks);
  sweep::write_snakefile(
      sweep.folder, chunks,
      {.program = own_program(), .options = options_of_tasks(command), .memory_bytes = limits.memory_bytes});
  print(count_of(chunks.size(), "chunk", "chunks") + ": snakemake -s " + (sweep.folder / "Snakefile").string() +
        " --cores 1\n");
}

std::optional<sweep::ChunkCounts> chunk_status(const std::filesystem::path& folder,
                                               std::span<const bench::MeasuredCase> cases) {
  const std::vector<sweep::Chunk> chunks = sweep::read_chunks(folder);
  if (chunks.empty()) return {};
  std::set<std::string> missing;
  for (const bench::MeasuredCase& measured : cases)
    if (bench::needs_run(measured)) missing.insert(measured.id);
  try {
    return sweep::count_chunks(chunks, sweep::ask_slurm(folder), missing);
  } catch (const Error& error) {  // the records can be counted without Slurm
    print_error_line(error.what());
    return {};
  }
}

bench::Json to_json(const sweep::ChunkCounts& counts) {
  return {{"queued", counts.queued},
          {"running", counts.running},
          {"missing", counts.missing},
          {"finished", counts.finished}};
}

std::string in_words(const sweep::ChunkCounts& counts) {
  const auto text = [](int count) { return bench::with_separators(static_cast<std::size_t>(count)); };
  return "chunks: " + text(counts.finished) + " finished, " + text(counts.running) + " running, " +
         text(counts.queued) + " queued, " + text(counts.missing) + " missing\n";
}

}  // namespace ccdt::tools
