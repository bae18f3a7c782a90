#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "bench/experiments/experiment.h"
#include "reports/report.h"

namespace ccdt::reports {
namespace {

using results::add_row, results::Column, results::ColumnKind, results::figure_column, results::label_column,
    results::table_of, results::time_column;

/// Columns that look like labels but state results, so they are compared.
bool is_outcome(const Column& column) {
  return column.name == "status" || column.name == "failure";
}

/// The labels of a row.
std::string key_of(const ResultTable& table, const ResultRow& row) {
  std::vector<std::string> labels;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (table.columns[c].kind == ColumnKind::label && !is_outcome(table.columns[c]))
      if (const auto* text = std::get_if<std::string>(&row.cells[c]); text != nullptr && !text->empty())
        labels.push_back(*text);
  return joined(labels);
}

/// The rows of a table by their labels; rows with equal labels stay in order.
std::unordered_map<std::string, std::deque<const ResultRow*>> rows_by_key(const ResultTable& table) {
  std::unordered_map<std::string, std::deque<const ResultRow*>> rows;
  for (const ResultRow& row : table.rows) rows[key_of(table, row)].push_back(&row);
  return rows;
}

/// The tables of the new section while it is built.
struct ComparisonTables {
  std::string first, second;  ///< folders, relative to that of the new report
  ResultTable summary =
      table_of("summary", "Summary",
               {label_column("experiment"), figure_column("figures", "deterministic figures"),
                figure_column("different", "of these different"),
                figure_column("others_different", "different, of other meshers"), figure_column("times"),
                figure_column("outside", "of these outside the first's interval"),
                figure_column("unmatched", "rows without a counterpart")});
  ResultTable times =
      table_of("times", "Times",
               {label_column("experiment"), label_column("table"), label_column("row"), label_column("quantity"),
                time_column("first"), time_column("second"), time_column("ratio", "second / first"),
                figure_column("within", "within the first's interval")});
  ResultTable differences = table_of("differences", "Figures that differ but should not",
                                     {label_column("experiment"), label_column("table"), label_column("row"),
                                      label_column("quantity"), figure_column("first"), figure_column("second")});
};

/// The row of an experiment in the summary.
struct ComparisonCounts {
  std::uint64_t figures = 0, different = 0, others_different = 0, times = 0, outside = 0, unmatched = 0;
};

/// Other meshers need not be deterministic.
bool is_of_another_mesher(const ResultTable& table, const ResultRow& row) {
  const auto mesher = std::ranges::find(table.columns, "mesher", &Column::name);
  return mesher != table.columns.end() && results::text_in(table, row, "mesher") != "ccdt";
}

/// Compares one experiment.
class ExperimentComparison {
 public:
  ExperimentComparison(std::string experiment, ComparisonTables& tables)
      : experiment_(std::move(experiment)), tables_(tables) {}

  /// Rows are matched by labels; rows with equal labels are matched by position.
  void compare_tables(const ResultTable& first, const ResultTable& second) {
    auto others = rows_by_key(second);
    for (const ResultRow& row : first.rows) {
      std::deque<const ResultRow*>& alike = others[key_of(first, row)];
      if (alike.empty()) {
        ++counts_.unmatched;
        continue;
      }
      for (std::size_t c = 0; c < first.columns.size(); ++c) {
        const auto same = std::ranges::find(second.columns, first.columns[c].name, &Column::name);
        if (same - second.columns.begin() == static_cast<std::ptrdiff_t>(c))
          compare_cells(first, c, row, *alike.front());
      }
      alike.pop_front();
    }
  }

  void add_summary() {
    const ComparisonCounts& n = counts_;
    add_row(tables_.summary, {}, experiment_, n.figures, n.different, n.others_different, n.times, n.outside,
            n.unmatched);
  }

 private:
  void compare_cells(const ResultTable& table, std::size_t column, const ResultRow& a, const ResultRow& b) {
    const Column& c = table.columns[column];
    const Cell &first = a.cells[column], &second = b.cells[column];
    const auto add = [&](ResultTable& to, const auto&... more) {
      std::vector<std::string> runs;
      for (const std::string& run : a.runs) runs.push_back(tables_.first + "/" + run);
      for (const std::string& run : b.runs) runs.push_back(tables_.second + "/" + run);
      add_row(to, runs, experiment_, table.title, key_of(table, a), c.title, first, second, more...);
    };
    if (c.kind == ColumnKind::figure || is_outcome(c)) {
      const bool is_same = results::cell_json(first) == results::cell_json(second);
      if (is_of_another_mesher(table, a)) {
        counts_.others_different += !is_same;
        return;
      }
      ++counts_.figures;
      counts_.different += !is_same;
      if (!is_same) add(tables_.differences);
    }
    const auto *e = std::get_if<bench::Estimate>(&first), *f = std::get_if<bench::Estimate>(&second);
    if (table.is_data || c.kind != ColumnKind::time || e == nullptr || f == nullptr) return;
    if (e->value == 0 || !e->has_interval()) return;
    const bool is_within = f->value >= e->low && f->value <= e->high;
    ++counts_.times;
    counts_.outside += !is_within;
    add(tables_.times, f->value / e->value, is_within);
  }

  std::string experiment_;
  ComparisonTables& tables_;
  ComparisonCounts counts_;
};

void compare_experiments(const ExperimentResult& first, const ExperimentResult& second, ComparisonTables& tables) {
  ExperimentComparison comparison(first.name, tables);
  for (const ResultTable& table : first.tables)
    if (const ResultTable* other = results::find_table(second, table.name)) comparison.compare_tables(table, *other);
  comparison.add_summary();
}

ResultTable verdicts_table(const Report& first, const Report& second) {
  ResultTable table =
      table_of("verdicts", "Verdicts",
               {label_column("claim"), experiments::note_column("first"), experiments::note_column("second")});
  for (const PaperClaim& claim : first.claims)
    if (const auto other = std::ranges::find(second.claims, claim.id, &PaperClaim::id); other != second.claims.end())
      add_row(table, {}, claim.sentence, name_of(claim.verdict), name_of(other->verdict));
  return table;
}

std::string finding_of(const ResultTable& summary, const char* all, const char* different, const char* words) {
  double total = 0, wrong = 0;
  for (const ResultRow& row : summary.rows) {
    total += results::number_in(summary, row, all);
    wrong += results::number_in(summary, row, different);
  }
  return experiments::share_words(static_cast<std::uint64_t>(total - wrong), static_cast<std::uint64_t>(total)) + words;
}

/// The runs of one folder by their names in the new report.
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
  ComparisonTables tables{.first = name_from(into, first), .second = name_from(into, second)};
  ReportSection section;
  for (const ReportSection& s : a.sections) {
    const auto other = std::ranges::find(b.sections, s.result.name, [](const auto& o) { return o.result.name; });
    if (s.is_missing || other == b.sections.end() || other->is_missing) {
      if (!s.is_missing || (other != b.sections.end() && !other->is_missing))
        section.result.problems.push_back(s.result.title + ": only in one of the folders");
      continue;
    }
    compare_experiments(s.result, other->result, tables);
    section.result.how = other->result.how;
  }
  section.result.name = "comparison";
  section.result.title = "Comparison of " + first.string() + " and " + second.string();
  section.result.how.command = "ccdt report " + first.string() + " " + second.string();
  section.result.findings = {
      finding_of(tables.summary, "figures", "different", " deterministic figures are equal bit for bit."),
      finding_of(tables.summary, "times", "outside", " times are within the interval of the first folder.")};
  section.result.definitions = {
      "Deterministic figures are counts and measures of meshes: the same inputs and options must give the same "
      "figures.",
      "Figures of other meshers are counted separately: not all are deterministic (Mesh_3 is not when it perturbs).",
      "A time agrees if the value of the second folder is within the interval of the first.",
      "Rows are matched by their labels."};
  section.result.is_good = tables.differences.rows.empty();
  section.result.tables = {tables.summary, verdicts_table(a, b), tables.differences, tables.times};
  section.charts = charts_for(section.result, charts);
  Report report;
  report.title = section.result.title;
  take_runs(a, tables.first, report);
  take_runs(b, tables.second, report);
  report.sections = {section};
  return report;
}

}  // namespace ccdt::reports
