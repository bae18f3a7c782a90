#include "bench/experiments/improvement.h"

#include "bench/experiments/criteria.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

/// Is no other row of the case better?
bool is_best(const QualityCase& c, const QualityRow& row, Criterion criterion) {
  const double ours = value_of(row.quality, criterion);
  for (const QualityRow& other : c.rows)
    if (other.ok() && is_better(criterion, value_of(other.quality, criterion), ours)) return false;
  return row.ok();
}

/// In how many cases each part is the best, alone or with others.
ResultTable best_table(const ImprovementParts& parts) {
  ResultTable table{"best",
                    "The best in so many cases",
                    {{"improve", "improvement", ColumnKind::label},
                     {"criterion", "by", ColumnKind::label},
                     {"cases", "cases"},
                     {"best", "best in"}}};
  if (parts.cases.empty()) return table;
  for (std::size_t i = 0; i < parts.cases.front().rows.size(); ++i)
    for (const Criterion criterion : judged_criteria) {
      std::uint64_t best = 0;
      for (const QualityCase& c : parts.cases) best += i < c.rows.size() && is_best(c, c.rows[i], criterion);
      table.rows.push_back({{cell_of(parts.cases.front().rows[i].variant), cell_of(name_of(criterion)),
                             cell_of(parts.cases.size()), cell_of(best)},
                            {}});
    }
  return table;
}

}  // namespace

std::vector<std::string> improvement_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(definitions.end(),
                     {
                         "none: the constrained Delaunay tetrahedralization with its FCC lattice.",
                         "swap: other tetrahedra of the same vertices. smooth: other places for them.",
                         "all: both, and vertices inside are inserted and taken out.",
                         "Improve: median seconds of the improvement, which are part of the seconds.",
                     });
  return definitions;
}

ImprovementParts measure_improvement(const ExperimentOptions& options, const Progress& progress) {
  StudyPlan plan{.experiment = "improvement",
                 .models = names_of_paper_models(),
                 .labels = {{"improve", "improvement", ColumnKind::label}},
                 .variants = {}};
  for (const char* improve : {"none", "swap", "smooth", "all"})
    plan.variants.push_back({improve, "ccdt", {"--lattice", "fcc", "--improve", improve}, {improve}});
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const ImprovementParts& parts) {
  ExperimentResult result = study_result(parts);
  result.definitions = improvement_definitions();
  result.tables.insert(result.tables.begin(), best_table(parts));
  return result;
}

}  // namespace ccdt
