#include "bench/experiments/locators.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

std::string_view check_words(const LocatorsCase& c) {
  return c.face_protection ? "on" : "off";
}

const std::vector<Column> case_columns = {{"model", "model", ColumnKind::label},
                                          {"kind", "kind", ColumnKind::label},
                                          {"face_protection", "check", ColumnKind::label}};

std::vector<Cell> case_cells(const LocatorsCase& c) {
  return {cell_of(c.name), cell_of(name_of(c.kind)), cell_of(check_words(c))};
}

ResultTable table_of(std::string name, std::string title, const std::vector<Column>& more) {
  ResultTable table{std::move(name), std::move(title), case_columns};
  table.columns.insert(table.columns.end(), more.begin(), more.end());
  return table;
}

void add_row(ResultTable& table, const LocatorsCase& c, const std::vector<Cell>& more,
             const std::vector<std::string>& runs) {
  table.rows.push_back({case_cells(c), runs});
  table.rows.back().cells.insert(table.rows.back().cells.end(), more.begin(), more.end());
}

ResultTable front_table(const Locators& locators) {
  ResultTable table = table_of("front", "Seconds of the front",
                               {{"locator", "locator", ColumnKind::label},
                                {"status", "status", ColumnKind::label},
                                {"seconds", "seconds", ColumnKind::time, "s"},
                                {"front_tetrahedra", "tetrahedra of the front"},
                                {"reason", "reason", ColumnKind::note}});
  for (const LocatorsCase& c : locators.cases)
    for (const LocatorsRow& row : c.rows)
      add_row(table, c,
              {cell_of(name_of(row.locator)), cell_of(name_of(row.status)), cell_of(row.seconds),
               cell_of(c.counts.front_tetrahedra), cell_of(row.reason)},
              row.runs);
  return table;
}

ResultTable ratios_table(const Locators& locators) {
  ResultTable table = table_of("ratios", "Beside the paper's grid",
                               {{"ratio", "ratio", ColumnKind::label}, {"value", "here", ColumnKind::time}});
  for (const LocatorsCase& c : locators.cases) {
    std::vector<std::string> runs;
    for (const LocatorsRow& row : c.rows) runs.insert(runs.end(), row.runs.begin(), row.runs.end());
    if (c.octree_over_grid) add_row(table, c, {cell_of("octree / grid"), *c.octree_over_grid}, runs);
    if (c.cavity_over_grid) add_row(table, c, {cell_of("cavity / grid"), *c.cavity_over_grid}, runs);
  }
  return table;
}

ResultTable sizes_table(const Locators& locators) {
  ResultTable table = table_of("sizes", "The surfaces",
                               {{"edge_ratio", "longest edge over shortest"},
                                {"vertices", "vertices"},
                                {"faces", "faces"},
                                {"undelaunay_faces", "faces that are not Delaunay"}});
  for (const LocatorsCase& c : locators.cases)
    add_row(table, c,
            {c.edge_ratio, cell_of(c.counts.vertices), cell_of(c.counts.faces), cell_of(c.counts.undelaunay_faces)},
            c.rows.empty() ? std::vector<std::string>() : c.rows.front().runs);
  return table;
}

std::vector<std::string> findings_of(const Locators& locators) {
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

}  // namespace

ExperimentResult result_of(const Locators& locators) {
  ExperimentResult result{.how = locators.how,
                          .definitions = locators_definitions(),
                          .tables = {front_table(locators), ratios_table(locators), sizes_table(locators)},
                          .findings = findings_of(locators)};
  for (const LocatorsCase& c : locators.cases)
    for (const LocatorsRow& row : c.rows) {
      if (row.status == RunStatus::ok) continue;
      result.problems.push_back(c.name + ", check " + std::string(check_words(c)) + ", " +
                                std::string(name_of(row.locator)) + ": " + std::string(name_of(row.status)) + ": " +
                                row.reason);
      result.is_good = false;
    }
  return result;
}

}  // namespace ccdt
