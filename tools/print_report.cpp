#include "tools/print_report.h"

#include <cstdio>

#include "reports/text_table.h"
#include "tools/share_folder.h"

namespace ccdt {
namespace {

std::string verdicts(const Report& report) {
  TextTable table = {{"the paper's claim", "verdict"}};
  for (const PaperClaim& claim : report.claims) table.push_back({claim.sentence, std::string(name_of(claim.verdict))});
  return to_terminal(table);
}

}  // namespace

void print_where(const WrittenReport& written, const std::filesystem::path& folder) {
  for (const std::string& note : written.notes) std::fprintf(stderr, "%s\n", note.c_str());
  const auto place = std::filesystem::absolute(written.page.empty() ? folder : written.page).lexically_normal();
  std::printf("\nThe report is in\n%s\n", place.c_str());
}

void make_report(const std::filesystem::path& folder) {
  const Report report = read_report(folder, read_charts(share_folder() / "charts"));
  std::fputs(verdicts(report).c_str(), stdout);
  for (const ReportSection& section : report.sections)
    if (section.is_missing)
      std::printf("\nMissing: %s %s\n  %s\n", section.result.title.c_str(), section.reason.c_str(),
                  section.result.how.command.c_str());
  print_where(write_report(report, folder, share_folder()), folder);
}

}  // namespace ccdt
