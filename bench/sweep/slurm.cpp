#include "bench/sweep/slurm.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <tuple>
#include <utility>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "bench/run/json.h"
#include "bench/run/json_fields.h"
#include "engine/base/errors.h"
#include "engine/io/files.h"

namespace ccdt::sweep {
namespace {

/// A job array. Task i runs the i-th chunk.
struct SlurmJob {
  std::string name;  ///< unique among jobs
  std::string id;    ///< the number from Slurm; empty: Slurm has not answered yet
  std::vector<int> chunks;
};

}  // namespace
}  // namespace ccdt::sweep

namespace ccdt::bench {
template <>
inline constexpr auto fields<sweep::SlurmJob> = std::make_tuple(field("name", &sweep::SlurmJob::name),
                                                                field("id", &sweep::SlurmJob::id),
                                                                field("chunks", &sweep::SlurmJob::chunks));
}  // namespace ccdt::bench

namespace ccdt::sweep {
namespace {

constexpr bench::DocumentKind jobs_kind = {"ccdt.slurm/1", "this is not a list of the jobs of a sweep",
                                           "cancel the sweep's jobs with scancel, and remove the file"};
constexpr double seconds_for_slurm = 120;  ///< a controller that restarts takes a while
constexpr double time_factor = 3;          ///< a chunk may take this much longer than its estimate
constexpr double margin_seconds = 600;

std::filesystem::path slurm_folder(const std::filesystem::path& folder) {
  return folder / "slurm";
}

std::filesystem::path jobs_file(const std::filesystem::path& folder) {
  return slurm_folder(folder) / "jobs.json";
}

std::vector<SlurmJob> read_jobs(const std::filesystem::path& folder) {
  std::vector<SlurmJob> jobs;
  if (has_slurm_jobs(folder))
    bench::parse_document(jobs_file(folder), jobs_kind, [&](const bench::Json& json) { json.at("jobs").get_to(jobs); });
  return jobs;
}

void write_jobs(const std::filesystem::path& folder, const std::vector<SlurmJob>& jobs) {
  bench::write_json({{"schema", jobs_kind.schema}, {"jobs", jobs}}, jobs_file(folder));
}

/// The output of a program of Slurm. \throw Error  it is missing or failed
std::string call_slurm(std::vector<std::string> command) {
  const std::string name = command.front();
  const auto program = baselines::find_on_path(name);
  if (!program)
    throw InputError("there is no program '" + name + "' on PATH", {},
                     "log in to a machine that submits jobs; or omit --slurm to run the sweep here");
  command.front() = program->string();
  const baselines::TemporaryFolder scratch;
  const auto log = scratch.path() / "log";
  const auto result =
      baselines::run_program(command, {.log = log, .limits = baselines::Limits{.seconds = seconds_for_slurm}});
  std::string printed = std::filesystem::file_size(log) == 0 ? "" : io::read_whole_file(log).bytes;
  if (result.status == baselines::RunStatus::ok) return printed;
  printed.erase(printed.find_last_not_of(" \n") + 1);
  throw InputError("'" + name + "' failed: " + (printed.empty() ? result.reason : printed), {},
                   "nothing was submitted; repeat the command when Slurm answers");
}

/// A unique name that people recognize.
std::string new_name(const std::filesystem::path& folder) {
  std::random_device random;
  std::ostringstream name;
  name << "ccdt-" << std::filesystem::absolute(folder).lexically_normal().filename().string() << '-' << std::hex
       << random();
  std::string text = name.str();
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'; }, '_');
  return text;
}

std::string minutes_for(std::span<const Chunk> chunks, double longest_run) {
  double longest = longest_run;
  for (const Chunk& chunk : chunks) longest = std::max(longest, time_factor * chunk.seconds);
  return std::to_string(static_cast<long long>(std::ceil((longest + margin_seconds) / 60)));
}

/// The script of each task. Its arguments are the numbers of the chunks.
std::string script(const std::filesystem::path& folder, const SlurmOptions& options) {
  const std::vector<std::string> sweep = {std::filesystem::absolute(options.program).string(), "sweep",
                                          std::filesystem::absolute(folder).string()};
  return "#!/bin/sh\n"
         "# Runs one chunk of a sweep; the arguments are the numbers of all chunks.\n"
         "shift \"$SLURM_ARRAY_TASK_ID\"\n"
         "exec " +
         baselines::command_line(sweep) + " --chunk \"$1\" " + baselines::command_line(options.options) + "\n";
}

std::vector<std::string> command_of(const std::filesystem::path& folder, const SlurmJob& job,
                                    std::span<const Chunk> chunks, const SlurmOptions& options,
                                    const std::filesystem::path& script_file) {
  const auto logs = std::filesystem::absolute(slurm_folder(folder) / "%A_%a.log").string();
  int threads = 1;
  for (const Chunk& chunk : chunks) threads = std::max(threads, chunk.threads);
  std::vector<std::string> command = {"sbatch",
                                      "--parsable",
                                      "--requeue",
                                      "--open-mode=append",
                                      "--job-name=" + job.name,
                                      "--array=0-" + std::to_string(chunks.size() - 1),
                                      "--output=" + logs,
                                      "--ntasks=1",
                                      "--cpus-per-task=" + std::to_string(threads),
                                      "--time=" + minutes_for(chunks, options.seconds)};
  if (const auto megabytes = task_megabytes(options.memory_bytes); megabytes > 0)
    command.push_back("--mem=" + std::to_string(megabytes) + "M");
  command.push_back(std::filesystem::absolute(script_file).string());
  for (const Chunk& chunk : chunks) command.push_back(std::to_string(chunk.number));
  return command;
}

/// A line of `squeue`: a task of one of our jobs.
struct QueuedTask {
  std::string name, job, state;
  std::size_t task = 0;
};

std::vector<QueuedTask> queued_tasks() {
  const std::string printed =
      call_slurm({"squeue", "--noheader", "--array", "--user=" + std::to_string(getuid()), "--format=%F %K %T %j"});
  std::vector<QueuedTask> tasks;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    QueuedTask task;
    std::string number;
    if (!(words >> task.job >> number >> task.state >> task.name)) continue;
    if (std::from_chars(number.data(), number.data() + number.size(), task.task).ec != std::errc()) continue;
    tasks.push_back(std::move(task));
  }
  return tasks;
}

/// The cases that are waiting or running.
std::set<std::string> cases_of(const std::vector<Chunk>& chunks, const SlurmQueue& queue) {
  std::set<std::string> cases;
  for (const Chunk& chunk : chunks)
    if (queue.has(chunk.number)) cases.insert(chunk.cases.begin(), chunk.cases.end());
  return cases;
}

/// Submits chunks, whose files exist, to Slurm. Returns the id of the job.
std::string submit(const std::filesystem::path& folder, std::span<const Chunk> chunks, const SlurmOptions& options) {
  const std::vector<SlurmJob> before = read_jobs(folder);
  SlurmJob job{new_name(folder), "", {}};
  for (const Chunk& chunk : chunks) job.chunks.push_back(chunk.number);
  const auto script_file = slurm_folder(folder) / (job.name + ".sh");
  io::OutputFile file(script_file);
  file << script(folder, options);
  file.commit();

  std::vector<SlurmJob> jobs = before;
  jobs.push_back(job);
  write_jobs(folder, jobs);
  try {
    jobs.back().id = call_slurm(command_of(folder, job, chunks, options, script_file));
  } catch (const Error&) {
    write_jobs(folder, before);
    throw;
  }
  jobs.back().id.erase(jobs.back().id.find_first_of(";\n"));  // a federation adds the name of the cluster
  write_jobs(folder, jobs);
  return jobs.back().id;
}

}  // namespace

bool has_slurm_jobs(const std::filesystem::path& folder) {
  return io::is_there(jobs_file(folder));
}

SlurmQueue ask_slurm(const std::filesystem::path& folder) {
  SlurmQueue queue;
  std::map<std::string, SlurmJob> jobs;
  for (SlurmJob& job : read_jobs(folder)) jobs[job.name] = std::move(job);
  if (jobs.empty()) return queue;
  for (const QueuedTask& task : queued_tasks()) {
    const auto job = jobs.find(task.name);
    if (job == jobs.end() || task.task >= job->second.chunks.size()) continue;
    const bool is_running = task.state == "RUNNING" || task.state == "COMPLETING";
    (is_running ? queue.running : queue.queued).insert(job->second.chunks[task.task]);
  }
  return queue;
}

Submission submit_to_slurm(const std::filesystem::path& folder, const SlurmOptions& options,
                           const std::function<std::vector<MissingCase>()>& missing) {
  std::filesystem::create_directories(slurm_folder(folder));
  Submission submission{.job = "", .before = ask_slurm(folder)};
  const std::set<std::string> taken = cases_of(read_chunks(folder), submission.before);
  std::vector<MissingCase> cases = missing();
  std::erase_if(cases, [&](const MissingCase& c) { return taken.contains(c.id); });
  if (cases.empty()) return submission;
  submission.chunks = cut_into_chunks(cases, options.chunk_seconds);
  write_chunks(folder, submission.chunks);
  submission.job = submit(folder, submission.chunks, options);
  return submission;
}

ChunkCounts count_chunks(std::span<const Chunk> chunks, const SlurmQueue& queue,
                         const std::set<std::string>& missing_cases) {
  ChunkCounts counts;
  std::set<std::string> known;
  for (auto chunk = chunks.rbegin(); chunk != chunks.rend(); ++chunk) {
    bool is_missing = false;
    for (const std::string& id : chunk->cases) {
      const bool is_newest = known.insert(id).second;
      is_missing = is_missing || (is_newest && missing_cases.contains(id));
    }
    if (queue.running.contains(chunk->number))
      ++counts.running;
    else if (queue.queued.contains(chunk->number))
      ++counts.queued;
    else
      ++(is_missing ? counts.missing : counts.finished);
  }
  return counts;
}

}  // namespace ccdt::sweep
