#include "reports/locators_report.h"

#include "bench/run_record.h"
#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/text_table.h"

namespace ccdt {
namespace {

std::string check_words(const LocatorsCase& c) {
  return c.face_protection ? "on" : "off";
}

TextTable sizes(const Locators& locators) {
  TextTable cells = {
      {"surface", "kind", "check", "edge ratio", "vertices", "faces", "not Delaunay", "front's tetrahedra"}};
  for (const LocatorsCase& c : locators.cases)
    cells.push_back({c.name, std::string(name_of(c.kind)), check_words(c), rounded(c.edge_ratio),
                     with_separators(c.counts.vertices), with_separators(c.counts.faces),
                     with_separators(c.counts.undelaunay_faces), with_separators(c.counts.front_tetrahedra)});
  return cells;
}

TextTable seconds(const Locators& locators) {
  TextTable cells = {{"front seconds", "check", "grid", "octree", "cavity", "octree / grid", "cavity / grid"}};
  for (const LocatorsCase& c : locators.cases) {
    cells.push_back({c.name, check_words(c)});
    for (const LocatorsRow& row : c.rows)
      cells.back().push_back(row.seconds ? with_interval(*row.seconds) : std::string(name_of(row.status)));
    for (const auto& ratio : {c.octree_over_grid, c.cavity_over_grid})
      cells.back().push_back(ratio ? with_interval(*ratio) : "");
  }
  return cells;
}

std::vector<std::string> verdict(const Locators& locators) {
  std::vector<std::string> lines;
  for (const LocatorsCase& c : locators.cases) {
    const auto claim = expectation(c);
    if (!claim) continue;
    const bool is_graded = c.kind == SurfaceKind::graded;
    lines.push_back(
        c.name + ": that the " + (is_graded ? "octree is faster than the grid" : "grid is faster than the octree") +
        " where edges " + (is_graded ? "differ by a factor of " + rounded(c.edge_ratio) : "are even") + ": " +
        (*claim == Claim::undecided ? "undecided"
         : *claim == Claim::holds   ? "holds"
                                    : "does not hold") +
        " (octree / grid " + with_interval(*c.octree_over_grid) + ")");
  }
  return lines;
}

std::vector<std::string> complaints(const Locators& locators) {
  std::vector<std::string> lines;
  for (const LocatorsCase& c : locators.cases)
    for (const LocatorsRow& row : c.rows)
      if (row.status != RunStatus::ok)
        lines.push_back(c.name + ", check " + check_words(c) + ", " + std::string(name_of(row.locator)) + ": " +
                        std::string(name_of(row.status)) + ": " + row.reason);
  return lines;
}

constexpr const char* title = "Locators: who finds the front's vertices and occluders fastest";

}  // namespace

std::string to_terminal(const Locators& locators) {
  return std::string(title) + "\n\n" + to_terminal(sizes(locators)) + "\n" + to_terminal(seconds(locators)) + "\n" +
         terminal_section("Octree or grid?", verdict(locators)) +
         terminal_section("What went wrong", complaints(locators)) + how_measured(locators.how) + "\n";
}

std::string to_markdown(const Locators& locators) {
  return "# " + std::string(title) + "\n\n" + how_measured(locators.how) + "\n\n" + to_markdown(sizes(locators)) +
         "\n" + to_markdown(seconds(locators)) + "\n" + section("Octree or grid?", verdict(locators)) +
         section("What went wrong", complaints(locators)) + closing_sections(locators_definitions(), locators.how);
}

}  // namespace ccdt
