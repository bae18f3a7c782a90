#include "reports/lattices_report.h"

#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/quality_tables.h"

namespace ccdt {
namespace {

TextTable claims_table(const Lattices& lattices) {
  TextTable cells = {{"FCC is best in", "mesh", "confirmed", "cases", "fcc best", "bcc best", "sc best"}};
  for (const LatticeClaim& claim : lattice_claims(lattices))
    cells.push_back({std::string(name_of(claim.criterion)), claim.improved ? "improved" : "as made",
                     claim.is_confirmed() ? "yes" : "no", with_separators(claim.cases), with_separators(claim.best[0]),
                     with_separators(claim.best[1]), with_separators(claim.best[2])});
  return cells;
}

std::vector<std::string> verdict(const Lattices& lattices) {
  std::vector<std::string> lines;
  for (const bool improved : {false, true}) {
    std::string confirmed, refuted;
    for (const LatticeClaim& claim : lattice_claims(lattices)) {
      if (claim.improved != improved || claim.cases == 0) continue;
      std::string& list = claim.is_confirmed() ? confirmed : refuted;
      list += (list.empty() ? "" : ", ") + std::string(name_of(claim.criterion));
    }
    const std::string meshes = improved ? "after improvement by: " : "before improvement by: ";
    if (!confirmed.empty()) lines.push_back(("That FCC is best is confirmed " + meshes).append(confirmed));
    if (!refuted.empty()) lines.push_back(("That FCC is best is not confirmed " + meshes).append(refuted));
  }
  return lines;
}

constexpr const char* title = "Lattices: is FCC the best, as the paper says?";

}  // namespace

std::string to_terminal(const Lattices& lattices) {
  return std::string(title) + "\n\n" + cases_to_terminal(lattices) + to_terminal(claims_table(lattices)) + "\n" +
         terminal_section("What this says", verdict(lattices)) +
         terminal_section("What went wrong", complaints_of(lattices)) + how_studied(lattices) + "\n";
}

std::string to_markdown(const Lattices& lattices) {
  return "# " + std::string(title) + "\n\n" + how_studied(lattices) + "\n\n" + to_markdown(claims_table(lattices)) +
         "\n" + section("What this says", verdict(lattices)) + section("What went wrong", complaints_of(lattices)) +
         "## The surfaces\n\n" + to_markdown(surfaces_table(lattices)) + "\n" + cases_to_markdown(lattices) +
         closing_sections(lattices_definitions(), lattices.how);
}

}  // namespace ccdt
