#include <cstdio>
#include <memory>

#include "engine/base/errors.h"
#include "reports/comparison.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/print_report.h"
#include "tools/share_folder.h"

namespace ccdt {
namespace {

struct ReportCommand {
  std::vector<std::string> folders;
  std::string output;
};

void compare(const ReportCommand& command) {
  const std::filesystem::path first = command.folders[0], second = command.folders[1];
  const std::filesystem::path into =
      command.output.empty() ? second / "comparison" : std::filesystem::path(command.output);
  std::filesystem::create_directories(into);
  const Report report = compare_reports(first, second, into, read_charts(share_folder() / "charts"));
  for (const ReportSection& section : report.sections) std::fputs(to_terminal(section.result).c_str(), stdout);
  print_where(write_report(report, into, share_folder()), into);
}

void run(const ReportCommand& command) {
  if (command.folders.size() == 2) return compare(command);
  make_report(command.folders[0]);
}

constexpr const char* footer =
    "The folder is one that `ccdt reproduce` has filled. All is made anew from the JSON files in it: report.json,\n"
    "claims.json, NAME.md, tables/ (Markdown, CSV, LaTeX), figures/ (SVG, PDF, PNG) and the page index.html.\n"
    "What is missing is said in the report.\n\n"
    "Example: the report of a folder, after one of its experiments was made again\n"
    "  ccdt reproduce fig8 -o build/paper --scale paper && ccdt report build/paper\n"
    "Example: what has changed from one folder to the other; the report goes to new/comparison\n"
    "  ccdt report old new\n";

}  // namespace

void add_report_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ReportCommand>();
  CLI::App* verb = app.add_subcommand("report", "tables, figures and the page from the JSON of a folder");
  verb->add_option("DIR", command->folders, "a folder that `ccdt reproduce` has filled; two are compared")
      ->required()
      ->expected(1, 2)
      ->check(CLI::ExistingDirectory);
  verb->add_option("-o,--output", command->output, "folder of a comparison; default: comparison in the second DIR");
  verb->footer(footer);
  verb->callback([command, &exit_code] {
    if (command->folders.size() == 1 && !command->output.empty())
      throw CLI::ValidationError("--output", "a report goes to its own folder; only a comparison has another");
    run(*command);
    exit_code = done;
  });
}

}  // namespace ccdt
