#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "bench/sweep_results/sweep_tables.h"

namespace ccdt::sweep_results {
namespace {

using results::Cell;
using results::cell_of;
using results::Column;
using results::ColumnKind;
using results::ResultRow;

constexpr double mebibyte = 1 << 20;

/// Options that change how a mesh is made, never the mesh: for the same vertices every strategy gives the same
/// tetrahedra.
constexpr auto strategies =
    std::to_array<std::string_view>({"face-protection", "locator", "delaunay", "grid-scale", "threads"});

ResultTable begin_table(const Sweep& sweep, std::string name, std::string title, std::vector<Column> more) {
  ResultTable table{std::move(name), std::move(title), label_columns(sweep)};
  std::ranges::move(more, std::back_inserter(table.columns));
  return table;
}

ResultRow begin_row(const CaseSummary& summary) {
  return {label_cells(summary), summary.runs};
}

void append(ResultRow& row, std::vector<Cell> cells) {
  std::ranges::move(cells, std::back_inserter(row.cells));
}

std::string texts_of(const CaseSummary& summary, RunField field) {
  return std::string(text_of(summary, field));
}

Cell estimate_or_number(const CaseSummary& summary) {
  if (summary.seconds && summary.counted.size() == 1) return summary.seconds->value;
  return cell_of(summary.seconds);
}

/// Cases that must have the same mesh have the same key.
std::string key_of_mesh(const Sweep& sweep, const SweepCase& one) {
  std::string key = one.input;
  for (std::size_t i = 0; i < sweep.options.size(); ++i)
    if (std::ranges::find(strategies, sweep.options[i]) == strategies.end()) key += '\n' + one.options[i];
  return key;
}

}  // namespace

ResultTable cases_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  ResultTable table = begin_table(sweep, "cases", "Cases",
                                  {{"status", "status", ColumnKind::label},
                                   {"failure", "failure", ColumnKind::label},
                                   {"reason", "reason", ColumnKind::note},
                                   {"spread", "spread", ColumnKind::note},
                                   {"runs", "counted runs", ColumnKind::time},
                                   {"vertices", "vertices", ColumnKind::figure},
                                   {"tetrahedra", "tetrahedra", ColumnKind::figure},
                                   {"seconds", "seconds", ColumnKind::time, "s"},
                                   {"memory", "peak memory", ColumnKind::time, "MiB"},
                                   {"worst_r", "worst r", ColumnKind::figure},
                                   {"mean_r", "mean r", ColumnKind::figure},
                                   {"p99_r", "99% of r below", ColumnKind::figure},
                                   {"min_dihedral", "smallest dihedral angle", ColumnKind::figure, "degrees"},
                                   {"max_dihedral", "largest dihedral angle", ColumnKind::figure, "degrees"},
                                   {"verified", "verified", ColumnKind::figure}});
  for (const CaseSummary& s : cases) {
    ResultRow row = begin_row(s);
    append(row, {s.status, s.kind, s.reason, s.spread, static_cast<double>(s.counted.size())});
    const bool ok = s.is_solved();
    const auto figure = [&](RunField field) { return ok ? cell_of(number_of(s, field)) : Cell(); };
    append(row, {figure("vertices"), figure("tetrahedra"), estimate_or_number(s),
                 s.peak_bytes > 0 ? Cell(s.peak_bytes / mebibyte) : Cell(), figure("r_max"), figure("r_mean"),
                 figure("r_p99"), figure("dihedral_min"), figure("dihedral_max"), texts_of(s, "verified")});
    table.rows.push_back(std::move(row));
  }
  return table;
}

ResultTable solved_table(const Sweep& sweep, std::span<const CaseSummary> cases) {
  ResultTable table = begin_table(sweep, "solved", "Solved cases",
                                  {{"series", "series", ColumnKind::note},
                                   {"legend", "legend", ColumnKind::note},
                                   {"seconds", "seconds", ColumnKind::time, "s"}});
  table.is_data = true;
  for (const CaseSummary& s : cases) {
    if (!s.seconds) continue;
    ResultRow row = begin_row(s);
    append(row, {s.series, s.legend, s.seconds->value});
    table.rows.push_back(std::move(row));
  }
  return table;
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
  ResultTable table = begin_table(sweep, "same_mesh", "Strategies that must give the same mesh",
                                  {{"strategies", "strategies", ColumnKind::figure},
                                   {"meshes", "different meshes", ColumnKind::figure},
                                   {"same", "the same", ColumnKind::figure}});
  for (const auto& [key, group] : groups) {
    if (group.size() < 2) continue;
    std::set<std::string_view> meshes;
    ResultRow row = begin_row(*group.front());
    row.runs.clear();
    for (std::size_t i = 0; i < sweep.options.size(); ++i)  // a row stands for all values of its strategies
      if (std::ranges::find(strategies, sweep.options[i]) != strategies.end())
        row.cells[row.cells.size() - sweep.options.size() + i] = Cell();
    for (const CaseSummary* one : group) {
      meshes.insert(text_of(*one, "mesh_fingerprint"));
      row.runs.push_back(one->runs.front());
    }
    append(row, {static_cast<double>(group.size()), static_cast<double>(meshes.size()), cell_of(meshes.size() == 1)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace ccdt::sweep_results
