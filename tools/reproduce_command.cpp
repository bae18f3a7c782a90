#include <cstdio>
#include <memory>

#include "baselines/mesher.h"
#include "bench/experiments/table1.h"
#include "engine/io/output_file.h"
#include "reports/table1_report.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/progress_bar.h"

namespace ccdt {
namespace {

constexpr double bytes_per_gibibyte = 1024.0 * 1024 * 1024;

struct ReproduceCommand {
  std::vector<std::string> experiments = {"table1"};
  std::string folder;
  Table1Options table1;
  std::vector<std::string> beside;
  double memory_gibibytes = 0;
};

void write_text(const std::string& text, const std::filesystem::path& file) {
  io::OutputFile output(file);
  output << text;
  output.commit();
}

/// Did everything of our own go well? A baseline that fails is a row of the table, not a failure of the program.
bool is_good(const Table1& table) {
  for (const Table1Model& model : table.models) {
    if (!model.same_tetrahedra) return false;
    for (const Table1Row& row : model.rows)
      if (row.paper_seconds && row.status != RunStatus::ok) return false;
  }
  return true;
}

bool run(ReproduceCommand& command) {
  command.table1.program = std::filesystem::read_symlink("/proc/self/exe");
  command.table1.folder = command.folder;
  if (!command.beside.empty()) command.table1.beside = command.beside;
  command.table1.limits.memory_bytes = static_cast<std::uint64_t>(command.memory_gibibytes * bytes_per_gibibyte);
  std::filesystem::create_directories(command.table1.folder);
  check_can_be_written(command.table1.folder / "table1.json");

  Table1 table;
  {
    ProgressBar bar;
    table = measure_table1(command.table1, bar.progress());
  }
  write_text(to_json(table), command.table1.folder / "table1.json");
  write_text(to_markdown(table), command.table1.folder / "table1.md");
  std::fputs(to_terminal(table).c_str(), stdout);
  return is_good(table);
}

}  // namespace

void add_reproduce_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ReproduceCommand>();
  CLI::App* verb = app.add_subcommand("reproduce", "run the paper's experiments, end to end, to a report");
  verb->add_option("EXPERIMENT", command->experiments, "table1; default: all")->check(CLI::IsMember({"table1"}));
  verb->add_option("-o,--output", command->folder, "folder of the report; made if need be")->required();
  verb->add_option("--runs", command->table1.runs, "counted runs of each case")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  verb->add_option("--scale", command->table1.scale,
                   "factor of the models' edge lengths: more than 1 is coarser and faster")
      ->check(positive_number())
      ->capture_default_str();
  std::vector<std::string> others;
  for (const Mesher& m : meshers())
    if (m.name != "ccdt") others.push_back(m.name);
  verb->add_option("--beside", command->beside, "other meshers to measure, separated by commas; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(others));
  verb->add_option("--timeout", command->table1.limits.seconds, "limit of a single run, in seconds")
      ->check(positive_number())
      ->capture_default_str();
  verb->add_option("--memory-limit", command->memory_gibibytes, "limit of a single run, in GiB; default: none")
      ->check(positive_number());
  verb->footer(
      "Every run is a process of its own; its report stays in DIR/runs, the table in DIR/table1.md and\n"
      "DIR/table1.json. A case that fails is a row with the reason.\n\n"
      "Example: the paper's Table 1\n"
      "  ccdt reproduce table1 -o build/table1\n");
  verb->callback([command, &exit_code] { exit_code = run(*command) ? done : failed_a_check; });
}

}  // namespace ccdt
