#include <algorithm>
#include <cstdio>
#include <memory>

#include "baselines/mesher.h"
#include "models/solids.h"
#include "tools/commands.h"
#include "tools/experiments.h"
#include "tools/options.h"

namespace ccdt {
namespace {

constexpr double bytes_per_gibibyte = 1024.0 * 1024 * 1024;

struct ReproduceCommand {
  std::vector<std::string> experiments = {"table1"};
  std::string folder;
  ExperimentOptions options;
  std::vector<std::string> beside;
  double memory_gibibytes = 0;
};

/// \return  did everything of our own go well?
bool run(ReproduceCommand& command) {
  ExperimentOptions& options = command.options;
  options.program = std::filesystem::read_symlink("/proc/self/exe");
  options.folder = command.folder;
  if (!command.beside.empty()) options.beside = command.beside;
  options.limits.memory_bytes = static_cast<std::uint64_t>(command.memory_gibibytes * bytes_per_gibibyte);
  std::filesystem::create_directories(options.folder);
  check_can_be_written(options.folder / "table1.json");
  bool is_good = true, is_first = true;
  for (const ReproducibleExperiment& experiment : reproducible_experiments()) {
    if (std::ranges::find(command.experiments, experiment.name) == command.experiments.end()) continue;
    if (!is_first) std::puts("");
    is_first = false;
    is_good = experiment.run(options) && is_good;
  }
  return is_good;
}

std::string footer() {
  std::string text = "Experiments, with their time on two cores:\n";
  for (const ReproducibleExperiment& e : reproducible_experiments()) {
    std::string name = e.name;
    name.resize(17, ' ');
    text += "  " + name + e.what + " (" + e.time + ")\n";
  }
  return text +
         "\nEvery run is a process of its own; its report stays in DIR/runs, that of the experiment in DIR as "
         "Markdown\n"
         "and JSON (fig8 also as CSV, one row a run). A case that fails is a row with the reason.\n\n"
         "Example: the paper's Table 1\n"
         "  ccdt reproduce table1 -o build/table1\n"
         "Example: the three locators, on a part of your own as well\n"
         "  ccdt reproduce locators -o build/locators --input part.stl\n"
         "Example: quality beside other meshers on parts alone, without the paper's models\n"
         "  ccdt reproduce quality -o build/quality --models none --input parts/*.off\n";
}

void add_limits(CLI::App& verb, ReproduceCommand& command) {
  verb.add_option("--timeout", command.options.limits.seconds, "limit of a single run, in seconds")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_option("--memory-limit", command.memory_gibibytes, "limit of a single run, in GiB; default: none")
      ->check(positive_number());
}

void add_what_to_measure(CLI::App& verb, ReproduceCommand& command) {
  verb.add_option("--runs", command.options.runs, "counted runs of each case")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  verb.add_option(
          "--scale", command.options.tetrahedra,
          "factor of the models' edge lengths, divisor of numbers of tetrahedra: more than 1 is coarser and faster")
      ->check(positive_number())
      ->capture_default_str();
  std::vector<std::string> models, others;
  for (const Solid& solid : solids()) models.emplace_back(solid.name);
  models.emplace_back("none");
  for (const Mesher& m : meshers())
    if (m.name != "ccdt") others.push_back(m.name);
  verb.add_option("--models", command.options.models,
                  "measure only these, separated by commas; default: all models of the experiment; none: files alone")
      ->delimiter(',')
      ->check(CLI::IsMember(models).description(""));
  verb.add_option("--input", command.options.inputs, "files to measure as well (not table1 and fig8)")
      ->check(CLI::ExistingFile);
  verb.add_option("--beside", command.beside,
                  "table1, quality: other meshers to measure, separated by commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(others));
}

}  // namespace

void add_reproduce_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ReproduceCommand>();
  CLI::App* verb = app.add_subcommand("reproduce", "run the paper's experiments, end to end, to a report");
  std::vector<std::string> names;
  for (const ReproducibleExperiment& e : reproducible_experiments()) names.push_back(e.name);
  verb->add_option("EXPERIMENT", command->experiments, "which (listed below); default: table1")
      ->check(CLI::IsMember(names).description(""));
  verb->add_option("-o,--output", command->folder, "folder of the report; made if need be")->required();
  add_what_to_measure(*verb, *command);
  add_limits(*verb, *command);
  verb->footer(footer());
  verb->callback([command, &exit_code] { exit_code = run(*command) ? done : failed_a_check; });
}

}  // namespace ccdt
