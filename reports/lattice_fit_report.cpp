#include "reports/lattice_fit_report.h"

#include <algorithm>

#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/quality_tables.h"

namespace ccdt {
namespace {

TextTable settings_table(const LatticeFit& fit) {
  TextTable cells = {
      {"setting", "rank", "mean r", "p99 r", "worst r", "largest", "smallest dihedral", "of all", "improve seconds"}};
  for (const SettingSummary& s : summarize(fit))
    cells.push_back({name_of(s.setting), rounded(s.rank), rounded(s.mean_r, 5), rounded(s.p99_r, 4),
                     rounded(s.worst_r, 4), rounded(s.largest_worst_r, 4), rounded(s.smallest_dihedral),
                     rounded(s.least_dihedral), rounded(s.improve_seconds)});
  return cells;
}

std::vector<std::string> verdict(const LatticeFit& fit) {
  const std::vector<SettingSummary> summaries = summarize(fit);
  if (summaries.empty()) return {"There is no surface on which every setting went well."};
  const auto usual = std::ranges::find(summaries, default_lattice_setting(), &SettingSummary::setting);
  auto best = std::ranges::min_element(summaries, {}, &SettingSummary::rank);
  if (usual->rank <= best->rank) best = usual;  // as good as any
  std::vector<std::string> lines = {"The best setting is " + name_of(best->setting) + ", with a mean rank of " +
                                    rounded(best->rank) + " among " + std::to_string(summaries.size())};
  if (best->setting == usual->setting)
    lines.emplace_back("It is the default");
  else
    lines.push_back("The default, " + name_of(usual->setting) + ", has a mean rank of " + rounded(usual->rank));
  return lines;
}

constexpr const char* title = "Lattice fit: how near to the surface should lattice points be?";

}  // namespace

std::string to_terminal(const LatticeFit& fit) {
  return std::string(title) + "\n\n" + to_terminal(settings_table(fit)) + "\n" +
         terminal_section("What this says", verdict(fit)) + terminal_section("What went wrong", complaints_of(fit)) +
         how_studied(fit) + "\n";
}

std::string to_markdown(const LatticeFit& fit) {
  return "# " + std::string(title) + "\n\n" + how_studied(fit) + "\n\n" + to_markdown(settings_table(fit)) + "\n" +
         section("What this says", verdict(fit)) + section("What went wrong", complaints_of(fit)) +
         "## The surfaces\n\n" + to_markdown(surfaces_table(fit)) + "\n" +
         closing_sections(lattice_fit_definitions(), fit.how);
}

}  // namespace ccdt
