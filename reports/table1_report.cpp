#include "reports/table1_report.h"

#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/table1_differences.h"
#include "reports/text_table.h"

namespace ccdt {
namespace {

/// The paper gives two digits after the point.
std::string paper_words(const std::optional<double>& value) {
  return value ? rounded(*value, *value < 100 ? 4 : 5) : "";
}

std::string measured_words(const Table1Row& row) {
  return row.seconds ? with_interval(*row.seconds) : std::string(name_of(row.status));
}

TextTable heading(const Table1& table, const std::string& first) {
  TextTable cells = {{first}};
  for (const Table1Model& model : table.models) {
    cells[0].push_back(model.name);
    cells[0].push_back("paper");
  }
  return cells;
}

TextTable sizes(const Table1& table) {
  TextTable cells = {
      {"model", "edge length", "vertices", "Steiner", "interior", "tetrahedra", "faces", "not Delaunay"}};
  for (const Table1Model& model : table.models) {
    const MeshCounts& c = model.rows.front().counts;
    cells.push_back({model.name, rounded(model.edge_length), with_separators(c.vertices),
                     with_separators(c.steiner_vertices), with_separators(c.interior_vertices),
                     with_separators(c.tetrahedra), with_separators(c.faces), with_separators(c.undelaunay_faces)});
  }
  return cells;
}

TextTable seconds(const Table1& table) {
  TextTable cells = heading(table, "seconds");
  if (table.models.empty()) return cells;
  for (std::size_t r = 0; r < table.models.front().rows.size(); ++r) {
    cells.push_back({table.models.front().rows[r].label});
    for (const Table1Model& model : table.models) {
      cells.back().push_back(measured_words(model.rows[r]));
      cells.back().push_back(paper_words(model.rows[r].paper_seconds));
    }
  }
  return cells;
}

TextTable ratios(const Table1& table) {
  TextTable cells = heading(table, "ratios");
  if (table.models.empty()) return cells;
  for (std::size_t r = 0; r < table.models.front().ratios.size(); ++r) {
    cells.push_back({table.models.front().ratios[r].label});
    for (const Table1Model& model : table.models) {
      const Table1Ratio& ratio = model.ratios[r];
      cells.back().push_back(ratio.value ? with_interval(*ratio.value) : "");
      cells.back().push_back(paper_words(ratio.paper));
    }
  }
  return cells;
}

/// Of the rows that stand for a mesh of their own; the times mean little without it.
TextTable tetrahedra(const Table1& table) {
  TextTable cells = {{"tetrahedra"}};
  for (const Table1Model& model : table.models) cells[0].push_back(model.name);
  if (table.models.empty()) return cells;
  for (std::size_t r = 0; r < table.models.front().rows.size(); ++r) {
    if (table.models.front().rows[r].paper_seconds) continue;
    cells.push_back({table.models.front().rows[r].label});
    for (const Table1Model& model : table.models)
      cells.back().push_back(model.rows[r].seconds ? with_separators(model.rows[r].counts.tetrahedra) : "");
  }
  return cells;
}

/// What went wrong, a line each; empty if nothing did.
std::vector<std::string> complaints(const Table1& table) {
  std::vector<std::string> lines;
  for (const Table1Model& model : table.models) {
    for (const Table1Row& row : model.rows)
      if (row.status != RunStatus::ok)
        lines.push_back(model.name + ", " + row.label + ": " + std::string(name_of(row.status)) + ": " + row.reason);
    if (!model.same_tetrahedra)
      lines.push_back(model.name + ": with and without the check, the tetrahedra differ, which is an error of ccdt");
  }
  return lines;
}

std::string how(const Table1& table) {
  return how_measured(table.how) + " The paper's: Pentium IV, 2.0 GHz.";
}

constexpr const char* differences_title = "Where this differs from the paper, and why";

}  // namespace

std::string to_terminal(const Table1& table) {
  std::string text = "Table 1: constrained Delaunay tetrahedralization with and without the face protection check\n\n";
  text += to_terminal(sizes(table)) + "\n" + to_terminal(seconds(table)) + "\n" + to_terminal(ratios(table)) + "\n" +
          to_terminal(tetrahedra(table)) + "\n";
  for (const std::string& line : complaints(table)) text += line + "\n";
  return text + terminal_section(differences_title, table1_differences(table)) + how(table) + "\n";
}

std::string to_markdown(const Table1& table) {
  std::string text = "# Table 1: CDT with and without the face protection check\n\n" + how(table) + "\n\n";
  text += to_markdown(sizes(table)) + "\n" + to_markdown(seconds(table)) + "\n" + to_markdown(ratios(table)) + "\n" +
          to_markdown(tetrahedra(table)) + "\n";
  return text + section("What went wrong", complaints(table)) + section(differences_title, table1_differences(table)) +
         closing_sections(table1_definitions(), table.how);
}

}  // namespace ccdt
