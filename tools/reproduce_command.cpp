#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "baselines/mesher.h"
#include "baselines/stop.h"
#include "bench/experiments/registry.h"
#include "bench/run/identity.h"
#include "bench/run/json.h"
#include "bench/run/median_interval.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"
#include "models/solids.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/folder_lock.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/progress_bar.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

constexpr double bytes_per_gibibyte = 1024.0 * 1024 * 1024;

/// How large experiments are, by name.
struct NamedScale {
  const char* name;
  double tetrahedra;
  const char* what;
};
constexpr const char *full_scale = "full", *older_name_of_full_scale = "paper";
constexpr std::array<NamedScale, 3> named_scales = {
    {{"quick", 8000,
      "8,000 tetrahedra per model: everything in 4 minutes on two cores; times over short ranges decide nothing"},
     {full_scale, 100000, "100,000, and up to four million in fig8: everything in 45 minutes, for verdicts"},
     {"large", 1000000, "ten times as many"}}};

constexpr const char* claims_name = "claims";
constexpr const char* identity_file = "identity.json";

struct ReproduceCommand {
  std::vector<std::string> experiments;
  std::string folder;
  experiments::ExperimentOptions options;
  std::vector<std::string> beside;
  double memory_gibibytes = 0;
  bool refresh = false, mixed = false, retry_failed = false;
};

/// \throw CLI::ValidationError  neither a name nor a number
double tetrahedra_of(const std::string& scale) {
  const auto named = std::ranges::find(named_scales, scale, &NamedScale::name);
  if (named != named_scales.end()) return named->tetrahedra;
  constexpr double fewest = 100, most = 1e8;
  double tetrahedra = 0;
  const auto [end, error] = std::from_chars(scale.data(), scale.data() + scale.size(), tetrahedra);
  const bool is_number = error == std::errc() && end == scale.data() + scale.size();
  const bool is_within = tetrahedra >= fewest && tetrahedra <= most;
  if (!is_number || !is_within)
    throw CLI::ValidationError("--scale", "'" + scale +
                                              "' is not quick, full, large or a number of tetrahedra "
                                              "from 100 to 10^8");
  return tetrahedra;
}

/// The chosen experiments, in the order of reports.
std::vector<const experiments::KnownExperiment*> chosen(const ReproduceCommand& command) {
  const auto is_named = [&](const std::string& name) {
    return std::ranges::find(command.experiments, name) != command.experiments.end();
  };
  std::vector<const experiments::KnownExperiment*> experiments;
  for (const experiments::KnownExperiment& known : experiments::known_experiments()) {
    const bool is_usual = command.experiments.empty() && known.is_usual;
    if (is_usual || is_named(known.name) || (known.is_claimed && is_named(claims_name))) experiments.push_back(&known);
  }
  return experiments;
}

/// Copies a user's file to the folder, so that everything can be repeated there.
/// \return  the copy
std::filesystem::path taken(const std::filesystem::path& file, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  auto copy = std::filesystem::absolute(folder / file.filename());
  if (std::filesystem::exists(copy) && std::filesystem::equivalent(copy, file)) return copy;
  std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
  return copy;
}

/// \throw InputError  two of them have the same name
void check_names_differ(const std::vector<std::filesystem::path>& files) {
  std::set<std::filesystem::path> names;
  for (const auto& file : files) {
    if (names.insert(file.filename()).second) continue;
    throw InputError("two inputs have the same name", io::place_in(file.string()),
                     "rename one of them: the rows of a table are told apart by these names");
  }
}

/// Copies the user's inputs and descriptions of meshers into the folder.
void take_files(ReproduceCommand& command) {
  check_names_differ(command.options.inputs);
  for (auto& input : command.options.inputs) input = taken(input, command.options.folder / "inputs");
  for (std::string& mesher : command.beside)
    if (baselines::is_mesher_description(mesher)) mesher = taken(mesher, command.options.folder / "meshers").string();
  if (!command.beside.empty()) command.options.beside = command.beside;
}

/// The command that repeats this experiment alone, to be called in the folder.
std::string command_of(const experiments::KnownExperiment& known, const ReproduceCommand& command) {
  const experiments::ExperimentOptions& options = command.options;
  const auto in_folder = [&](const std::filesystem::path& file) {
    return file.lexically_relative(std::filesystem::absolute(options.folder)).string();
  };
  std::vector<std::string> beside = command.beside, inputs;
  for (std::string& mesher : beside)
    if (baselines::is_mesher_description(mesher)) mesher = in_folder(mesher);
  for (const auto& input : options.inputs) inputs.push_back(in_folder(input));
  std::string text = "ccdt reproduce " + known.name + " --scale " + options.scale;
  const auto add_list = [&](const char* name, const std::vector<std::string>& values, char separator) {
    for (std::size_t i = 0; i < values.size(); ++i)
      text += (i == 0 ? " " + std::string(name) + " " : std::string(1, separator)) + values[i];
  };
  const experiments::ExperimentOptions usual;
  if (options.runs != usual.runs) text += " --runs " + std::to_string(options.runs);
  if (options.limits.seconds != usual.limits.seconds) text += " --timeout " + digits(options.limits.seconds);
  if (command.memory_gibibytes > 0) text += " --memory-limit " + digits(command.memory_gibibytes);
  add_list("--models", options.models, ',');
  add_list("--beside", beside, ',');
  add_list("--input", inputs, ' ');
  if (!options.corpus.empty()) text += " --corpus " + in_folder(options.corpus);
  return text + " -o .";
}

/// The machines and programs whose records count in the folder; also writes them there.
/// \throw InputError  the records come from another program or machine, and no option says what to do
std::vector<bench::Identity> identities_of(const ReproduceCommand& command) {
  std::vector<std::string> meshers;
  for (const baselines::Mesher& mesher : baselines::meshers()) meshers.push_back(mesher.name);
  std::ranges::copy_if(command.beside, std::back_inserter(meshers), baselines::is_mesher_description);
  const auto file = command.options.folder / identity_file;
  const bench::OtherIdentity policy = command.refresh ? bench::OtherIdentity::refresh
                                      : command.mixed ? bench::OtherIdentity::mixed
                                                      : bench::OtherIdentity::refuse;
  auto accepted = bench::accepted_identities(file, bench::identity_of(meshers, command.options.program), policy);
  bench::Json json = {{"schema", "ccdt.identity/1"}};
  json.update(bench::identities_json(accepted));
  bench::write_json(json, file);
  return accepted;
}

/// Measures with a progress bar, writes the result to the folder and prints it.
/// \return  did ccdt itself succeed everywhere?
bool reproduce(const experiments::KnownExperiment& known, ReproduceCommand& command,
               const std::vector<bench::Identity>& identities) {
  command.options.command = command_of(known, command);
  const results::ExperimentResult result = [&] {
    ProgressBar bar;
    const auto progress = [draw = bar.progress()](std::string_view what, std::uint64_t done, std::uint64_t total) {
      if (baselines::stop_requested()) throw baselines::Stopped();
      report(draw, what, done, total);
    };
    bench::Runner runner({.program = command.options.program,
                          .folder = command.options.folder,
                          .identities = identities,
                          .retry_failed = command.retry_failed,
                          .progress = progress});
    return known.measure(command.options, runner);
  }();
  results::write_experiment_result(result, command.options.folder);
  print(reports::to_terminal(result) + "\n");
  return result.is_good;
}

/// \return  did ccdt itself succeed everywhere?
bool run(ReproduceCommand& command) {
  experiments::ExperimentOptions& options = command.options;
  if (options.scale == older_name_of_full_scale) options.scale = full_scale;
  options.tetrahedra = tetrahedra_of(options.scale);
  options.program = own_program();
  options.folder = std::filesystem::absolute(command.folder).lexically_normal();
  if (!options.corpus.empty()) options.corpus = std::filesystem::absolute(options.corpus).lexically_normal();
  options.limits.memory_bytes = static_cast<std::uint64_t>(command.memory_gibibytes * bytes_per_gibibyte);
  std::filesystem::create_directories(options.folder);
  const FolderLock lock(options.folder);
  take_files(command);
  check_can_be_written(options.folder / "report.json");
  const std::vector<bench::Identity> identities = identities_of(command);
  bool is_good = true;
  for (const experiments::KnownExperiment* known : chosen(command))
    is_good = reproduce(*known, command, identities) && is_good;
  make_report(options.folder);
  return is_good;
}

ExitCode run_until_stopped(ReproduceCommand& command) {
  const baselines::StopSignals signals;
  try {
    return run(command) ? done : failed_a_check;
  } catch (const baselines::Stopped&) {
    print_error_line("stopped: all finished runs are kept; repeat the command to continue");
    throw;
  }
}

std::string reproduce_footer() {
  std::string text = "Experiments. If none is named, all run except those in brackets:\n";
  for (const experiments::KnownExperiment& e : experiments::known_experiments())
    text += list_line(e.name, e.is_usual ? e.what : "[" + e.what + "]");
  text += list_line(claims_name, "all experiments that test a claim of the paper") + "\nScales:\n";
  for (const NamedScale& scale : named_scales) text += list_line(scale.name, scale.what);
  return text +
         "\nEvery run is a separate process. Its report stays in DIR/runs; that of an experiment is DIR/NAME.json. "
         "Nothing is run twice: if the command is stopped, call it again, and it continues where it was. "
         "A case that fails is a row with the reason. At the end, tables, figures and the page are made from "
         "all experiments in DIR, as by `ccdt report DIR`.\n\n"
         "Example: reproduce the whole paper, in minutes\n"
         "  ccdt reproduce -o build/reproduction\n"
         "Example: reproduce Table 1 and Fig. 8 at the paper's size\n"
         "  ccdt reproduce table1 fig8 --scale full -o build/full\n"
         "Example: compare the three locators, also on a part of your own\n"
         "  ccdt reproduce locators -o build/locators --input part.stl\n"
         "Example: compare quality with other meshers, on your parts alone\n"
         "  ccdt reproduce quality -o build/quality --models none --input parts/*.off\n";
}

void add_limits(CLI::App& verb, ReproduceCommand& command) {
  verb.add_option("--timeout", command.options.limits.seconds, "time limit of a single run, in seconds")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_option("--memory-limit", command.memory_gibibytes, "memory limit of a single run, in GiB; default: none")
      ->check(positive_number());
}

void add_what_to_measure(CLI::App& verb, ReproduceCommand& command) {
  verb.add_option("--runs", command.options.runs,
                  "least number of counted runs of each timed case; more follow until its interval is narrow enough or "
                  "they take long")
      ->check(whole_number(bench::fewest_for_interval, 1000))
      ->capture_default_str();
  verb.add_option("--scale", command.options.scale,
                  "quick, full (formerly paper), large, or the approximate number of tetrahedra per model")
      ->capture_default_str();
  std::vector<std::string> models;
  for (const models::Solid& solid : models::solids()) models.emplace_back(solid.name);
  models.emplace_back("none");
  verb.add_option("--models", command.options.models,
                  "models to measure, separated by commas; default: all models of the experiment; none: only files")
      ->delimiter(',')
      ->check(one_of(models));
  verb.add_option("--input", command.options.inputs, "files to measure as well (not in table1 and the figures)")
      ->check(CLI::ExistingFile);
  verb.add_option("--corpus", command.options.corpus,
                  "folder with a corpus of parts, made by tools/corpus (robustness)")
      ->check(CLI::ExistingDirectory);
  verb.add_option("--beside", command.beside,
                  "other meshers to measure, or .json files that describe them, separated by commas; default: all of "
                  "this build")
      ->delimiter(',')
      ->check(known_mesher());
}

void add_what_to_keep(CLI::App& verb, ReproduceCommand& command) {
  auto* refresh = verb.add_flag("--refresh", command.refresh,
                                "if the folder comes from another program or machine: measure everything again");
  verb.add_flag("--mixed", command.mixed, "if the folder comes from another program or machine: keep what was measured")
      ->excludes(refresh);
  verb.add_flag("--retry-failed", command.retry_failed, "run failed cases again");
}

}  // namespace

void add_reproduce_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ReproduceCommand>();
  CLI::App* verb = app.add_subcommand("reproduce", "run the paper's experiments and write a report");
  command->options.scale = named_scales[0].name;
  std::vector<std::string> names = {claims_name};
  for (const experiments::KnownExperiment& e : experiments::known_experiments()) names.push_back(e.name);
  verb->add_option("EXPERIMENT", command->experiments, "experiments (listed below); default: all")
      ->check(one_of(names));
  verb->add_option("-o,--output", command->folder, "folder for the report; created if needed")->required();
  add_what_to_measure(*verb, *command);
  add_limits(*verb, *command);
  add_what_to_keep(*verb, *command);
  verb->footer(reproduce_footer());
  verb->callback([command, &exit_code] {
    exit_code = with_stage_of_limits(command->folder, "reproduce", [&] { return run_until_stopped(*command); });
  });
}

}  // namespace ccdt::tools
