#include "tools/sweep_command.h"

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "baselines/mesher.h"
#include "baselines/stop.h"
#include "bench/run/numbers.h"
#include "bench/sweep/estimate.h"
#include "bench/sweep/status.h"
#include "bench/sweep/sweep_document.h"
#include "engine/io/files.h"
#include "reports/result_text.h"
#include "tools/cluster_command.h"
#include "tools/commands.h"
#include "tools/folder_lock.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/progress_bar.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

constexpr std::size_t most_names = 5;  ///< names of cases in a message

/// The file of a spec, or the built-in spec of this name.
std::filesystem::path spec_file(const std::string& spec) {
  const auto known = share_folder() / "sweeps" / (spec + ".json");
  const bool is_known = !std::filesystem::is_regular_file(spec) && std::filesystem::exists(known);
  return is_known ? known : std::filesystem::path(spec);
}

sweep::SweepSpec spec_of(const SweepCommand& command, const sweep::MeshOptionRules& rules) {
  sweep::SweepSpec spec = sweep::read_spec(spec_file(command.spec), rules);
  if (!command.inputs.empty()) sweep::replace_files(spec, command.inputs);
  if (command.jobs > 1 && spec.repetitions.until > 0)
    throw CLI::ValidationError("--jobs",
                               "runs at the same time disturb each other's times, but 'repetitions' of the spec "
                               "asks for exact ones");
  return spec;
}

bench::OtherIdentity policy_of(const SweepCommand& command) {
  if (command.refresh) return bench::OtherIdentity::refresh;
  return command.mixed ? bench::OtherIdentity::mixed : bench::OtherIdentity::refuse;
}

std::filesystem::path program_of(const SweepCommand& command) {
  return command.program.empty() ? own_program() : command.program;
}

bench::RunnerSettings settings_of(const SweepCommand& command, const PreparedSweep& sweep) {
  return {.program = program_of(command),
          .folder = sweep.folder,
          .identities = sweep.identities,
          .seed = sweep.seed,
          .jobs = command.jobs,
          .retry_failed = command.retry_failed};
}

/// Gives each case the id that its records carry. If equal inputs make equal cases, only the first is kept.
std::vector<bench::MeasuredCase> identify(bench::Runner& runner, std::vector<sweep::SweepCase>& cases) {
  std::vector<bench::MeasuredCase> loaded = runner.load(sweep::asked_of(cases)), measured;
  std::vector<sweep::SweepCase> different;
  std::set<std::string> known;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool is_there = std::filesystem::exists(cases[i].input.file);  // a model may not have been written yet
    if (is_there && !known.insert(loaded[i].id).second) continue;
    cases[i].id = loaded[i].id;
    cases[i].older_ids = loaded[i].older_ids;
    different.push_back(std::move(cases[i]));
    measured.push_back(std::move(loaded[i]));
  }
  cases = std::move(different);
  return measured;
}

void print_names(const char* what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  print(bench::with_separators(names.size()) + " " + what + ":\n");
  for (std::size_t i = 0; i < std::min(most_names, names.size()); ++i) print("  " + names[i] + "\n");
  if (names.size() > most_names) print("  ...\n");
}

void print_changes(const sweep::SweepChanges& changes) {
  if (changes.none()) return;
  print("The sweep has changed since the last call.\n");
  print_names(changes.added.size() == 1 ? "case is new" : "cases are new", changes.added);
  print_names(
      changes.obsolete.size() == 1 ? "case is obsolete, its records stay" : "cases are obsolete, their records stay",
      changes.obsolete);
}

/// A sweep as described by its folder; nothing is written.
struct KnownSweep {
  PreparedSweep sweep;
  std::vector<bench::MeasuredCase> measured;
};

KnownSweep look_at(const SweepCommand& command) {
  const sweep::MeshOptionRules rules = mesh_option_rules();
  KnownSweep known = {{std::filesystem::absolute(command.folder).lexically_normal()}, {}};
  const sweep::SweepSpec spec = spec_of(command, rules);
  known.sweep.cases = sweep::expand(spec, known.sweep.folder, rules);
  if (std::filesystem::exists(sweep::sweep_file(known.sweep.folder)) && !command.refresh)
    known.sweep.identities = sweep::read_sweep(known.sweep.folder).identities;
  else
    known.sweep.identities = {bench::identity_of(spec.meshers, program_of(command))};
  bench::Runner runner(settings_of(command, known.sweep));
  known.measured = identify(runner, known.sweep.cases);
  return known;
}

void print_status(const SweepCommand& command) {
  const KnownSweep known = look_at(command);
  const sweep::SweepStatus status = sweep::status_of(known.measured, known.sweep.folder);
  const auto chunks = chunk_status(known.sweep.folder, known.measured);
  if (!command.json) {
    print(sweep::in_words(status) + (chunks ? in_words(*chunks) : ""));
    return;
  }
  bench::Json json = sweep::to_json(status);
  if (chunks) json["chunks"] = to_json(*chunks);
  print_data(bench::to_text(json));
}

void print_estimate(const SweepCommand& command) {
  const KnownSweep known = look_at(command);
  const auto estimates = sweep::estimate_cases(known.sweep.cases, known.measured);
  const sweep::SweepEstimate sum = sweep::sum_of(known.sweep.cases, known.measured, estimates);
  command.json ? print_data(bench::to_text(sweep::to_json(sum))) : print(sweep::in_words(sum));
}

ExitCode run_all(const SweepCommand& command) {
  std::filesystem::create_directories(command.folder);
  const FolderLock lock(command.folder);
  const PreparedSweep sweep = prepare_sweep(command);
  if (command.cluster.slurm || command.cluster.snakemake) {
    prepare_for_cluster(command, sweep);
    return done;
  }
  const ExitCode code = print_results(run_cases(command, sweep, sweep.cases));
  if (command.jobs > 1)
    print("\nTimes are not reliable: " + std::to_string(command.jobs) + " cases ran at the same time.\n");
  print("\nTables, figures and the page: ccdt report " + command.folder + "\n");
  return code;
}

ExitCode run(const SweepCommand& command) {
  if (command.status || command.dry_run) {
    command.status ? print_status(command) : print_estimate(command);
    return done;
  }
  const baselines::StopSignals signals;
  return command.cluster.chunk >= 0 ? run_chunk(command) : run_all(command);
}

/// Is the failure a fault of ccdt itself?
bool is_fault(const bench::MeasuredCase& measured) {
  using baselines::FailureKind;
  const auto kind = measured.first.kind;
  return measured.failed() && measured.asked.mesher == "ccdt" &&
         (kind == FailureKind::wrong || kind == FailureKind::crashed);
}

constexpr const char* sweep_footer =
    "The spec (JSON, schema ccdt.sweep/1) says which models and files, in which sizes, are meshed by which meshers "
    "with which options. Each run is a separate process with limits of time and memory; its report is a file in "
    "DIR/runs. Nothing is run twice: if the command is stopped, call it again, and it continues where it was. A case "
    "that "
    "fails is a result like any other. These specs come with the program:\n\n"
    "  scaling          our models of the paper's parts from 10^4 to 10^7 tetrahedra, with all meshers\n"
    "  strategies       every strategy of every stage\n"
    "  parts            your files, with all meshers: --input 'parts/*.off'\n\n"
    "Example: estimate how long it takes\n"
    "  ccdt sweep scaling -o build/scaling --dry-run\n"
    "Example: run it, and make its report\n"
    "  ccdt sweep scaling -o build/scaling && ccdt report build/scaling\n"
    "Example: all meshers on parts of your own\n"
    "  ccdt sweep parts -o build/parts --input 'parts/*.off'\n"
    "Example: run it on a cluster with Slurm. All nodes must see the folder and the program. Variables such as "
    "SBATCH_PARTITION set other options of sbatch. Call it again to submit lost runs\n"
    "  ccdt sweep scaling -o build/scaling --slurm --chunk-minutes 60\n"
    "Example: how far is it?\n"
    "  ccdt sweep scaling -o build/scaling --status\n";

}  // namespace

PreparedSweep prepare_sweep(const SweepCommand& command) {
  const sweep::MeshOptionRules rules = mesh_option_rules();
  PreparedSweep sweep{std::filesystem::absolute(command.folder).lexically_normal()};
  const sweep::SweepSpec spec = spec_of(command, rules);
  const auto file = sweep::sweep_file(sweep.folder);
  sweep.seed = spec.seed;
  sweep.cases = sweep::expand(spec, sweep.folder, rules);
  sweep.identities =
      bench::accepted_identities(file, bench::identity_of(spec.meshers, program_of(command)), policy_of(command));
  std::filesystem::create_directories(sweep.folder);
  ProgressBar bar;
  sweep::write_models(sweep.cases, command.refresh, bar.progress());
  bench::Runner runner(settings_of(command, sweep));
  identify(runner, sweep.cases);
  bar.erase();
  if (std::filesystem::exists(file)) print_changes(sweep::changes_since(sweep::read_sweep(sweep.folder), sweep.cases));
  sweep::write_sweep(sweep.folder, spec, sweep.identities, sweep.cases);
  return sweep;
}

std::vector<bench::MeasuredCase> load_cases(const SweepCommand& command, const PreparedSweep& sweep) {
  return bench::Runner(settings_of(command, sweep)).load(sweep::asked_of(sweep.cases));
}

std::vector<bench::MeasuredCase> run_cases(const SweepCommand& command, const PreparedSweep& sweep,
                                           std::span<const sweep::SweepCase> cases) {
  ProgressBar bar;
  std::uint64_t finished = 0, all = 0;
  bench::RunnerSettings settings = settings_of(command, sweep);
  settings.progress = [&, draw = bar.progress()](std::string_view name, std::uint64_t done, std::uint64_t total) {
    finished = done;
    all = total;
    report(draw, name, done, total);
  };
  try {
    return bench::Runner(std::move(settings)).run(sweep::asked_of(cases));
  } catch (const baselines::Stopped&) {
    bar.erase();
    print_error_line("stopped: " + bench::with_separators(finished) + " of " + bench::with_separators(all) +
                     " runs are finished; repeat the command to continue");
    throw;
  }
}

ExitCode print_results(std::span<const bench::MeasuredCase> cases) {
  struct Ends {
    std::size_t finished = 0;
    std::map<std::string, std::size_t> failed;
  };
  std::map<std::string, Ends> by_mesher;
  bool is_good = true;
  for (const bench::MeasuredCase& measured : cases) {
    Ends& ends = by_mesher[baselines::mesher(measured.asked.mesher).name];
    measured.failed() ? ++ends.failed[sweep::failure_of(measured)] : ++ends.finished;
    is_good = is_good && !is_fault(measured);
  }
  reports::TextTable table = {{"mesher", "cases", "finished", "failed"}};
  for (const auto& [mesher, ends] : by_mesher) {
    std::size_t failed = 0;
    std::vector<std::string> kinds;
    for (const auto& [kind, count] : ends.failed) {
      failed += count;
      kinds.push_back(kind + " " + bench::with_separators(count));
    }
    table.push_back({mesher, bench::with_separators(ends.finished + failed), bench::with_separators(ends.finished),
                     bench::joined(kinds)});
  }
  print(reports::to_terminal(table));
  return is_good ? done : failed_a_check;
}

void add_sweep_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<SweepCommand>();
  CLI::App* verb = app.add_subcommand("sweep", "mesh many inputs with many options and meshers; nothing is run twice");
  verb->add_option("SPEC", command->spec, "file that says what to run (.json), or one of the names below")->required();
  verb->add_option("-o,--output", command->folder, "folder for the results; created if needed");
  verb->add_option("--input", command->inputs, "files or patterns to mesh instead of the spec's files");
  verb->add_option("--jobs", command->jobs,
                   "number of cases to run at the same time; their times are then not reliable")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  verb->add_flag("--retry-failed", command->retry_failed, "run failed cases again");
  auto* refresh = verb->add_flag("--refresh", command->refresh,
                                 "if the folder comes from another program or machine: measure everything again");
  verb->add_flag("--mixed", command->mixed,
                 "if the folder comes from another program or machine: keep what was measured")
      ->excludes(refresh);
  auto* status = verb->add_flag("--status", command->status, "print the progress of the sweep and exit");
  verb->add_flag("--dry-run", command->dry_run, "print how much there is to run and what it takes, and exit")
      ->excludes(status);
  verb->add_flag("--json", command->json, "print --status and --dry-run as JSON");
  add_cluster_options(*verb, command->cluster);
  verb->footer(sweep_footer);
  verb->callback([command, &exit_code] {
    const bool names_folder = command->cluster.chunk >= 0;  // the first argument is a folder, not a spec
    if (command->folder.empty() && !names_folder) throw CLI::RequiredError("-o,--output");
    exit_code =
        with_stage_of_limits(names_folder ? command->spec : command->folder, "sweep", [&] { return run(*command); });
  });
}

}  // namespace ccdt::tools
