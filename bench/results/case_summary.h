#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/results/sweep_runs.h"
#include "bench/run/statistics.h"

namespace ccdt::results {

/// An interval with a half-width above this share of its value is too wide, whatever the spec says.
inline constexpr double widest_spread = 0.1;

/// A case as the tables show it.
struct CaseSummary {
  const CaseRuns* of = nullptr;
  std::string series;              ///< the mesher, with those of its options that vary: "ccdt bcc octree"
  std::string legend;              ///< the same with so few options that charts can distinguish all series: "ccdt bcc"
  std::string status = "not run";  ///< of its first run that failed, otherwise of all
  std::string kind, reason;        ///< of a failure
  const RunValues* run = nullptr;  ///< a failed one, otherwise a counted one; null: not run
  std::vector<const RunValues*> counted = {};
  std::vector<std::string> runs = {};  ///< files of the runs behind the row
  std::optional<bench::Estimate> seconds = {};
  std::string spread = {};  ///< what is wrong with the interval; empty: nothing
  double peak_bytes = 0;    ///< the largest of the counted runs

  bool is_run() const { return run != nullptr; }
  bool is_solved() const { return status == "ok"; }
};

/// The files of the runs behind a row, for `table_of_rows`.
inline const std::vector<std::string>& runs_of(const CaseSummary& summary) {
  return summary.runs;
}

/// Summaries of all cases in order; the intervals are computed on all cores.
std::vector<CaseSummary> summarize_cases(const Sweep& sweep);

/// None if the case has no run, or its record lacks the figure. Figures are the same in all runs of a case.
std::optional<double> number_of(const CaseSummary& summary, RunField field);
std::string_view text_of(const CaseSummary& summary, RunField field);

}  // namespace ccdt::results
