#include <algorithm>
#include <memory>

#include "bench/results/sweep_result.h"
#include "engine/base/errors.h"
#include "reports/report.h"
#include "reports/result_text.h"
#include "tools/commands.h"
#include "tools/limit_errors.h"
#include "tools/options.h"
#include "tools/terminal.h"

namespace ccdt::tools {
namespace {

struct ReportCommand {
  std::vector<std::string> folders;
  std::string output;
};

constexpr std::size_t most_rows = 20;  ///< rows of a sweep's table, on a terminal

/// The verdicts on the claims that were measured; empty if none was.
std::string verdicts(const reports::Report& report) {
  reports::TextTable table = {{"the paper's claim", "verdict"}};
  for (const reports::PaperClaim& claim : report.claims)
    if (!claim.measured.empty()) table.push_back({claim.sentence, std::string(words_of(claim.verdict))});
  return table.size() > 1 ? reports::to_terminal(table) : "";
}

/// Writes a report, and prints what could not be made and, last, where the report is.
void write_and_print(const reports::Report& report, const std::filesystem::path& folder) {
  const reports::WrittenReport written = [&] {
    try {
      return reports::write_report(report, folder, share_folder());
    } catch (MemoryError& error) {
      error.place().file = folder.string();  // whichever file of the program was read last
      throw;
    }
  }();
  std::ranges::for_each(written.notes, print_error_line);
  const auto place = std::filesystem::absolute(written.page.empty() ? folder : written.page).lexically_normal();
  print("\nThe report is in\n" + place.string() + "\n");
}

void compare(const ReportCommand& command) {
  const std::filesystem::path first = command.folders[0], second = command.folders[1];
  const std::filesystem::path into =
      command.output.empty() ? second / "comparison" : std::filesystem::path(command.output);
  std::filesystem::create_directories(into);
  const reports::Report report =
      reports::compare_reports(first, second, into, reports::read_charts(share_folder() / "charts"));
  for (const reports::ReportSection& section : report.sections) print(reports::to_terminal(section.result));
  write_and_print(report, into);
}

void run(const ReportCommand& command) {
  if (command.folders.size() == 2) return compare(command);
  make_report(command.folders[0]);
}

constexpr const char* report_footer =
    "The folder is one that `ccdt reproduce` or `ccdt sweep` has filled. Everything is made again from the JSON files "
    "in it: report.json, NAME.md, tables/ (Markdown, CSV, LaTeX), figures/ (SVG, PDF, PNG), the page index.html, and "
    "claims.json. The report says what is missing.\n\n"
    "A sweep also gets runs.csv and runs.jsonl, for pandas and R: one line for each run, with these "
    "columns:\n";

constexpr const char* examples =
    "`counted`: no for a warm-up run. `file`: the whole record. `seconds`: meshing alone. `verified` and `kind` are "
    "empty if the record does not say. Each option of the sweep has a column option_NAME. Unknown values are empty in "
    "CSV and null in JSON.\n\n"
    "Example: measure one experiment again, then update the report\n"
    "  ccdt reproduce fig8 -o build/full --scale full && ccdt report build/full\n"
    "Example: compare two folders; the report goes to new/comparison\n"
    "  ccdt report old new\n"
    "Example: get the median seconds of each mesher of a sweep, in Python\n"
    "  runs = pandas.read_csv('DIR/runs.csv'); runs[runs.counted == 'yes'].groupby('mesher').seconds.median()\n";

}  // namespace

std::filesystem::path own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

std::filesystem::path share_folder() {
  auto beside = own_program().parent_path() / "share" / "ccdt";
  if (std::filesystem::exists(beside)) return beside;
  return own_program().parent_path().parent_path() / "share" / "ccdt";
}

void make_report(const std::filesystem::path& folder) {
  const reports::Report report = reports::read_report(folder, reports::read_charts(share_folder() / "charts"));
  print(verdicts(report));
  for (const reports::ReportSection& section : report.sections)
    if (section.result.name == results::sweep_name) print(reports::to_terminal(section.result, most_rows));
  for (const reports::ReportSection& section : report.sections)
    if (section.is_missing)
      print("\nMissing: " + section.result.title + "\n  " + section.reason + "\n  " + section.result.how.command +
            "\n");
  write_and_print(report, folder);
}

void add_report_command(CLI::App& app, ExitCode& exit_code) {
  auto command = std::make_shared<ReportCommand>();
  CLI::App* verb = app.add_subcommand("report", "make tables, figures and the page from the JSON of a folder");
  verb->add_option("DIR", command->folders,
                   "folder that `ccdt reproduce` or `ccdt sweep` has filled; two folders are compared")
      ->required()
      ->expected(1, 2)
      ->check(CLI::ExistingDirectory);
  verb->add_option("-o,--output", command->output, "folder for a comparison; default: comparison in the second DIR");
  verb->footer(report_footer + ("  " + results::run_columns_help()) + "\n" + examples);
  verb->callback([command, &exit_code] {
    if (command->folders.size() == 1 && !command->output.empty())
      throw CLI::ValidationError("--output", "use it with two folders only: a report is written to its own folder");
    with_stage_of_limits(command->folders.back(), "report", [&] { run(*command); });
    exit_code = done;
  });
}

}  // namespace ccdt::tools
