#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/statistics.h"
#include "bench/sweep_results/sweep_runs.h"

namespace ccdt::sweep_results {

/// An interval wider than this share of its value on either side is too wide, whatever was asked for.
inline constexpr double widest_spread = 0.1;

/// What the tables say of a case.
struct CaseSummary {
  const SweepCase* of = nullptr;
  std::string series;              ///< the mesher, with those of its options that vary: "ccdt bcc octree"
  std::string legend;              ///< the same with so few options that charts can tell all series apart: "ccdt bcc"
  std::string status = "not run";  ///< of its first run that failed, else of all
  std::string kind, reason;        ///< of a failure
  const RunValues* run = nullptr;  ///< one that failed, else a counted one; null: not run
  std::vector<const RunValues*> counted = {};
  std::vector<std::string> runs = {};  ///< files of the runs that the row stands on
  std::optional<bench::Estimate> seconds = {};
  std::string spread = {};  ///< what is wrong with the interval; empty: nothing
  double peak_bytes = 0;    ///< the largest of the counted runs

  bool is_run() const { return run != nullptr; }
  bool is_solved() const { return status == "ok"; }
};

/// The files of the runs that a row stands on, for `results::table_of_rows`.
inline const std::vector<std::string>& runs_of(const CaseSummary& summary) {
  return summary.runs;
}

/// Of all cases, in their order; the intervals are computed on all cores.
std::vector<CaseSummary> summarize_cases(const Sweep& sweep);

/// Nothing if the case has no run, or its record does not say. Figures are the same in all of its runs.
std::optional<double> number_of(const CaseSummary& summary, RunField field);
std::string_view text_of(const CaseSummary& summary, RunField field);

}  // namespace ccdt::sweep_results
