#include "reports/claims/claim_rows.h"

#include <algorithm>
#include <utility>

namespace ccdt::reports {

bool was_measured(Results results, const std::string& experiment) {
  return std::ranges::find(results, experiment, &ExperimentResult::name) != results.end();
}

std::vector<ClaimRow> rows_of(Results results, const std::string& experiment, std::string_view table,
                              const std::map<std::string, std::string>& texts) {
  std::vector<ClaimRow> rows;
  const auto result = std::ranges::find(results, experiment, &ExperimentResult::name);
  const ResultTable* found = result == results.end() ? nullptr : results::find_table(*result, table);
  if (found == nullptr) return rows;
  for (const ResultRow& row : found->rows) {
    const ClaimRow candidate{experiment, found, &row};
    if (std::ranges::all_of(texts, [&](const auto& t) { return candidate.text(t.first) == t.second; }))
      rows.push_back(candidate);
  }
  return rows;
}

ClaimMeasure measure_of(const ClaimRow& row, std::string what, Cell value, std::string bound, BoundTest strong,
                        BoundTest weak) {
  return {std::move(what), std::move(value), std::move(bound), strong, weak,
          row.experiment,  row.table->name,  row.row->runs};
}

ClaimMeasure missing_measure(std::string what, std::string bound, std::string experiment, std::string table) {
  return {std::move(what),  {}, std::move(bound), BoundTest::undecided, BoundTest::undecided, std::move(experiment),
          std::move(table), {}};
}

BoundTest yes_or_no(bool holds) {
  return holds ? BoundTest::holds : BoundTest::fails;
}

}  // namespace ccdt::reports
