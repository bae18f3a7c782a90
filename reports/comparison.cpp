#include "reports/comparison.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/results/numbers.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

/// What is compared, and under which names the runs of both are found.
struct Sides {
  std::string first, second;  ///< folders, relative to that of the new report
};

std::vector<std::string> runs_of_both(const Sides& sides, const ResultRow& a, const ResultRow& b) {
  std::vector<std::string> runs;
  for (const std::string& run : a.runs) runs.push_back(sides.first + "/" + run);
  for (const std::string& run : b.runs) runs.push_back(sides.second + "/" + run);
  return runs;
}

/// The labels of a row.
std::string key_of(const ResultTable& table, const ResultRow& row) {
  std::string key;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].kind == ColumnKind::label)
      if (const auto* text = std::get_if<std::string>(&row.cells[c]); text != nullptr && !text->empty())
        key += (key.empty() ? "" : ", ") + *text;
  return key;
}

/// The row of the other table with the same labels: of several the one at the same place among them.
const ResultRow* counterpart(const ResultTable& table, std::size_t number, const ResultTable& other) {
  const std::string key = key_of(table, table.rows[number]);
  const auto is_alike = [&](const ResultTable& t) {
    return [&t, &key](const ResultRow& row) { return key_of(t, row) == key; };
  };
  auto before = std::ranges::count_if(table.rows.begin(), table.rows.begin() + static_cast<std::ptrdiff_t>(number),
                                      is_alike(table));
  for (const ResultRow& row : other.rows)
    if (is_alike(other)(row) && before-- == 0) return &row;
  return nullptr;
}

/// Whether a second measurement is what the first has announced.
struct TimePair {
  double ratio = 0;
  bool is_within = false;  ///< of the interval of the first
};

TimePair pair_of(const Estimate& first, const Estimate& second) {
  return {second.value / first.value, second.value >= first.low && second.value <= first.high};
}

/// The tables of the new section while they are filled.
struct Work {
  Sides sides;
  std::string experiment;
  ResultTable summary{"summary",
                      "In all",
                      {{"experiment", "experiment", ColumnKind::label},
                       {"figures", "deterministic figures"},
                       {"different", "of these different"},
                       {"others_different", "different, of other meshers"},
                       {"times", "times"},
                       {"outside", "of these outside the first's interval"},
                       {"unmatched", "rows without a counterpart"}}};
  ResultTable times{"times",
                    "Times",
                    {{"experiment", "experiment", ColumnKind::label},
                     {"table", "table", ColumnKind::label},
                     {"row", "row", ColumnKind::label},
                     {"quantity", "quantity", ColumnKind::label},
                     {"first", "first", ColumnKind::time},
                     {"second", "second", ColumnKind::time},
                     {"ratio", "second / first", ColumnKind::time},
                     {"within", "within the first's interval"}}};
  ResultTable differences{"differences",
                          "Figures that differ, though they should not",
                          {{"experiment", "experiment", ColumnKind::label},
                           {"table", "table", ColumnKind::label},
                           {"row", "row", ColumnKind::label},
                           {"quantity", "quantity", ColumnKind::label},
                           {"first", "first"},
                           {"second", "second"}}};
  struct Counts {
    std::uint64_t figures = 0, different = 0, others_different = 0, times = 0, outside = 0, unmatched = 0;
  } counts;
};

/// Others' programs need not repeat themselves.
bool is_of_another_mesher(const ResultTable& table, const ResultRow& row) {
  const auto mesher = std::ranges::find(table.columns, "mesher", &Column::name);
  return mesher != table.columns.end() && text_in(table, row, "mesher") != "ccdt";
}

void compare_cells(const ResultTable& table, std::size_t column, const ResultRow& a, const ResultRow& b, Work& work) {
  const Column& c = table.columns[column];
  const Cell &first = a.cells[column], &second = b.cells[column];
  const std::vector<Cell> names = {cell_of(work.experiment), cell_of(table.title), cell_of(key_of(table, a)),
                                   cell_of(c.title)};
  const auto add = [&](ResultTable& to, const std::vector<Cell>& more) {
    to.rows.push_back({names, runs_of_both(work.sides, a, b)});
    to.rows.back().cells.insert(to.rows.back().cells.end(), more.begin(), more.end());
  };
  if (c.kind == ColumnKind::figure) {
    const bool is_same = cell_json(first) == cell_json(second);
    if (is_of_another_mesher(table, a)) {
      work.counts.others_different += !is_same;
      return;
    }
    ++work.counts.figures;
    work.counts.different += !is_same;
    if (!is_same) add(work.differences, {first, second});
  }
  const auto *e = std::get_if<Estimate>(&first), *f = std::get_if<Estimate>(&second);
  if (c.kind != ColumnKind::time || e == nullptr || f == nullptr || !(e->value != 0)) return;
  const TimePair pair = pair_of(*e, *f);
  ++work.counts.times;
  work.counts.outside += !pair.is_within;
  add(work.times, {first, second, pair.ratio, cell_of(pair.is_within)});
}

void compare_tables(const ResultTable& first, const ResultTable& second, Work& work) {
  for (std::size_t r = 0; r < first.rows.size(); ++r) {
    const ResultRow* other = counterpart(first, r, second);
    if (other == nullptr) {
      ++work.counts.unmatched;
      continue;
    }
    for (std::size_t c = 0; c < first.columns.size(); ++c) {
      const auto same = std::ranges::find(second.columns, first.columns[c].name, &Column::name);
      if (same - second.columns.begin() == static_cast<std::ptrdiff_t>(c))
        compare_cells(first, c, first.rows[r], *other, work);
    }
  }
}

void compare_experiments(const ExperimentResult& first, const ExperimentResult& second, Work& work) {
  work.experiment = first.name;
  work.counts = {};
  for (const ResultTable& table : first.tables)
    if (const ResultTable* other = find_table(second, table.name)) compare_tables(table, *other, work);
  const Work::Counts& n = work.counts;
  work.summary.rows.push_back(
      {{cell_of(first.name), cell_of(n.figures), cell_of(n.different), cell_of(n.others_different), cell_of(n.times),
        cell_of(n.outside), cell_of(n.unmatched)},
       {}});
}

ResultTable verdicts_table(const Report& first, const Report& second) {
  ResultTable table{"verdicts",
                    "Verdicts",
                    {{"claim", "claim", ColumnKind::label},
                     {"first", "first", ColumnKind::note},
                     {"second", "second", ColumnKind::note}}};
  for (const PaperClaim& claim : first.claims)
    if (const auto other = std::ranges::find(second.claims, claim.id, &PaperClaim::id); other != second.claims.end())
      table.rows.push_back(
          {{cell_of(claim.sentence), cell_of(name_of(claim.verdict)), cell_of(name_of(other->verdict))}, {}});
  return table;
}

std::string finding_of(const ResultTable& summary, const char* all, const char* odd, const char* words) {
  double total = 0, wrong = 0;
  for (const ResultRow& row : summary.rows) {
    total += number_in(summary, row, all);
    wrong += number_in(summary, row, odd);
  }
  return with_separators(static_cast<std::uint64_t>(total - wrong)) + " of " +
         with_separators(static_cast<std::uint64_t>(total)) + words;
}

/// The runs of one of the folders, by their names in the new report.
void take_runs(const Report& from, const std::string& folder, Report& report) {
  for (const auto& [file, run] : from.runs) {
    RunLine line = run;
    if (!line.command.empty()) line.command = "cd " + folder + " && " + line.command;
    report.runs[(std::filesystem::path(folder) / file).string()] = line;
  }
}

std::string name_from(const std::filesystem::path& into, const std::filesystem::path& folder) {
  return std::filesystem::absolute(folder).lexically_normal().lexically_relative(
      std::filesystem::absolute(into).lexically_normal());
}

}  // namespace

Report compare_reports(const std::filesystem::path& first, const std::filesystem::path& second,
                       const std::filesystem::path& into, std::span<const ReportChart> charts) {
  const Report a = read_report(first, {}), b = read_report(second, {});
  Work work{.sides = {name_from(into, first), name_from(into, second)}, .experiment = {}, .counts = {}};
  ReportSection section;
  for (const ReportSection& s : a.sections) {
    const auto other = std::ranges::find(b.sections, s.result.name, [](const auto& o) { return o.result.name; });
    if (s.is_missing || other == b.sections.end() || other->is_missing) {
      if (!s.is_missing || (other != b.sections.end() && !other->is_missing))
        section.result.problems.push_back(s.result.title + ": only one of the folders has it");
      continue;
    }
    compare_experiments(s.result, other->result, work);
    section.result.how = other->result.how;
  }
  section.result.name = "comparison";
  section.result.title = "Comparison of " + first.string() + " and " + second.string();
  section.result.how.command = "ccdt report " + first.string() + " " + second.string();
  section.result.findings = {
      finding_of(work.summary, "figures", "different", " deterministic figures are the same, bit for bit."),
      finding_of(work.summary, "times", "outside", " times are within the interval that the first folder states.")};
  section.result.definitions = {
      "Deterministic figures are counts and measures of meshes: the same inputs and options must give the same ones.",
      "Figures of other meshers are counted apart: not all repeat themselves (Mesh_3 does not when it perturbs).",
      "Times are compared by the value of the second folder and the interval of the first.",
      "Rows belong together that have the same labels."};
  section.result.is_good = work.differences.rows.empty();
  section.result.tables = {work.summary, verdicts_table(a, b), work.differences, work.times};
  add_charts(charts, section);
  Report report;
  report.title = section.result.title;
  take_runs(a, work.sides.first, report);
  take_runs(b, work.sides.second, report);
  report.sections = {section};
  return report;
}

}  // namespace ccdt
