#include <algorithm>
#include <array>
#include <map>
#include <ranges>
#include <set>
#include <utility>

#include "bench/results/sweep_tables.h"

namespace ccdt::results {
namespace {

constexpr double mebibyte = 1 << 20;

/// Options that change how a mesh is made, never the mesh: for the same vertices every strategy gives the same
/// tetrahedra.
constexpr auto strategies =
    std::to_array<std::string_view>({"face-protection", "locator", "delaunay", "grid-scale", "threads"});

/// A number that solved cases have.
RowColumn<CaseSummary> figure_of_solved(std::string name, std::string title, RunField field, std::string unit = {}) {
  return {figure_column(std::move(name), std::move(title), std::move(unit)),
          [field](const CaseSummary& s) { return s.is_solved() ? number_of(s, field) : std::nullopt; }};
}

Cell estimate_or_number(const CaseSummary& summary) {
  if (summary.seconds && summary.counted.size() == 1) return summary.seconds->value;
  return cell_of(summary.seconds);
}

/// Cases that must have the same mesh have the same key.
std::string key_of_mesh(const Sweep& sweep, const CaseRuns& one) {
  std::string key = one.input.name;
  for (std::size_t i = 0; i < sweep.options.size(); ++i)
    if (std::ranges::find(strategies, sweep.options[i]) == strategies.end()) key += '\n' + one.values[i];
  return key;
}

}  // namespace

ResultTable cases_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  RowColumns<CaseSummary> columns = label_columns(sweep);
  const RowColumns<CaseSummary> more = {
      {label_column("status"), &CaseSummary::status},
      {label_column("failure"), &CaseSummary::kind},
      {note_column("reason"), &CaseSummary::reason},
      {note_column("spread"), &CaseSummary::spread},
      {time_column("runs", "counted runs"), [](const CaseSummary& s) { return std::uint64_t{s.counted.size()}; }},
      figure_of_solved("vertices", "", "vertices"),
      figure_of_solved("tetrahedra", "", "tetrahedra"),
      {time_column("seconds", "", "s"), estimate_or_number},
      {time_column("memory", "peak memory", "MiB"),
       [](const CaseSummary& s) { return cell_if(s.peak_bytes > 0, s.peak_bytes / mebibyte); }},
      figure_of_solved("worst_r", "", "r_max"),
      figure_of_solved("mean_r", "", "r_mean"),
      figure_of_solved("p99_r", "99% of r below", "r_p99"),
      figure_of_solved("min_dihedral", "smallest dihedral angle", "dihedral_min", "degrees"),
      figure_of_solved("max_dihedral", "largest dihedral angle", "dihedral_max", "degrees"),
      {figure_column("verified"), [](const CaseSummary& s) { return text_of(s, "verified"); }}};
  columns.insert(columns.end(), more.begin(), more.end());
  return table_of_rows("cases", "Cases", columns, cases);
}

ResultTable solved_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  RowColumns<CaseSummary> columns = label_columns(sweep);
  columns.emplace_back(note_column("series"), &CaseSummary::series);
  columns.emplace_back(note_column("legend"), &CaseSummary::legend);
  columns.emplace_back(time_column("seconds", "", "s"), [](const CaseSummary& s) { return s.seconds->value; });
  const auto is_timed = [](const CaseSummary& s) { return s.seconds.has_value(); };
  return table_of_rows("solved", "Solved cases", columns, cases | std::views::filter(is_timed), true);
}

ResultTable failures_table(std::span<const CaseSummary> cases) {
  std::set<std::string> kinds;
  std::map<std::string, std::map<std::string, std::uint64_t>> counts;  // by mesher and kind; "" is solved
  for (const CaseSummary& s : cases) {
    if (!s.is_run()) continue;
    ++counts[s.of->mesher][s.kind];
    if (!s.kind.empty()) kinds.insert(s.kind);
  }
  ResultTable table{"failures", "Failures by kind", {{"mesher", "mesher", ColumnKind::label}}};
  if (kinds.empty()) return table;
  table.columns.push_back({"solved", "solved", ColumnKind::figure});
  for (const std::string& kind : kinds) {
    std::string words = kind;
    std::ranges::replace(words, '_', ' ');
    table.columns.push_back({kind, words, ColumnKind::figure});
  }
  for (auto& [mesher, of_mesher] : counts) {
    ResultRow row{{mesher, cell_of(of_mesher[""])}};
    for (const std::string& kind : kinds) row.cells.push_back(cell_of(of_mesher[kind]));
    for (const CaseSummary& s : cases)
      if (s.of->mesher == mesher && !s.kind.empty()) row.runs.insert(row.runs.end(), s.runs.begin(), s.runs.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

ResultTable same_mesh_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  std::map<std::string, std::vector<const CaseSummary*>> groups;
  for (const CaseSummary& s : cases)
    if (s.of->mesher == "ccdt" && s.is_solved() && !text_of(s, "mesh_fingerprint").empty())
      groups[key_of_mesh(sweep, *s.of)].push_back(&s);
  ResultTable table = labeled_table(sweep, "same_mesh", "Strategies that must give the same mesh",
                                    {{"strategies", "strategies", ColumnKind::figure},
                                     {"meshes", "different meshes", ColumnKind::figure},
                                     {"same", "the same", ColumnKind::figure}});
  const RowColumns<CaseSummary> labels = label_columns(sweep);
  for (const auto& [key, group] : groups) {
    if (group.size() < 2) continue;
    std::set<std::string_view> meshes;
    std::vector<std::string> runs;
    for (const CaseSummary* one : group) {
      meshes.insert(text_of(*one, "mesh_fingerprint"));
      runs.push_back(one->runs.front());
    }
    std::vector<Cell> of_all = cells_of(labels, *group.front());
    for (std::size_t i = 0; i < sweep.options.size(); ++i)  // a row stands for all values of its strategies
      if (std::ranges::find(strategies, sweep.options[i]) != strategies.end())
        of_all[of_all.size() - sweep.options.size() + i] = Cell();
    add_labeled_row(table, std::move(runs), std::move(of_all),
                    cells(std::uint64_t{group.size()}, std::uint64_t{meshes.size()}, meshes.size() == 1));
  }
  return table;
}

}  // namespace ccdt::results
