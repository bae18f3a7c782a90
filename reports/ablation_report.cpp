#include "reports/ablation_report.h"

#include "bench/experiments/criteria.h"
#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/quality_tables.h"

namespace ccdt {
namespace {

/// In how many cases each variant is the best, alone or with others, by each criterion.
TextTable best_table(const Ablation& ablation) {
  TextTable cells = {{"best in so many cases"}};
  for (const Criterion criterion : judged_criteria) cells.front().emplace_back(name_of(criterion));
  if (ablation.cases.empty()) return cells;
  for (std::size_t i = 0; i < ablation.cases.front().rows.size(); ++i) {
    cells.push_back({ablation.cases.front().rows[i].variant});
    for (const Criterion criterion : judged_criteria) {
      std::uint64_t best = 0;
      for (const QualityCase& c : ablation.cases) {
        if (i >= c.rows.size() || !c.rows[i].ok()) continue;
        const double ours = value_of(c.rows[i].quality, criterion);
        bool is_best = true;
        for (const QualityRow& other : c.rows)
          is_best = is_best && !(other.ok() && is_better(criterion, value_of(other.quality, criterion), ours));
        best += is_best;
      }
      cells.back().push_back(with_separators(best));
    }
  }
  return cells;
}

constexpr const char* title = "Ablation: what swaps, smoothing and both do";

}  // namespace

std::string to_terminal(const Ablation& ablation) {
  return std::string(title) + "\n\n" + cases_to_terminal(ablation) + to_terminal(best_table(ablation)) + "\n" +
         terminal_section("What went wrong", complaints_of(ablation)) + how_studied(ablation) + "\n";
}

std::string to_markdown(const Ablation& ablation) {
  return "# " + std::string(title) + "\n\n" + how_studied(ablation) + "\n\n" + to_markdown(best_table(ablation)) +
         "\n" + section("What went wrong", complaints_of(ablation)) + "## The surfaces\n\n" +
         to_markdown(surfaces_table(ablation)) + "\n" + cases_to_markdown(ablation) +
         closing_sections(ablation_definitions(), ablation.how);
}

}  // namespace ccdt
