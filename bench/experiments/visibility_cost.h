#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// Machine instructions of a CDT in which every face goes through the front.
struct CdtInstructions {
  std::uint64_t delaunay = 0;          ///< of the Delaunay tetrahedralization
  std::uint64_t front = 0;             ///< of the front
  std::uint64_t visibility_tests = 0;  ///< of the front: whether a face of the input hides a vertex
  std::uint64_t others = 0;            ///< of face check and labels

  std::uint64_t cdt() const { return delaunay + front + others; }

  /// The share of visibility in the CDT, as a range from the tests alone to the whole front. The true share is in
  /// between, because the functions that look up faces that may hide a vertex also look up candidates.
  Estimate visibility_share() const;
};

/// \param profile  that callgrind wrote of `ccdt mesh --face-protection off`
/// \throw InputError  it is not such a profile, or the functions were inlined
CdtInstructions cdt_instructions(std::string_view profile);

/// A model, meshed without the check.
struct VisibilityCostRow : CaseRow {
  std::string model;
  std::optional<CdtInstructions> instructions = {};  ///< none if they could not be counted
  std::string why_missing = {};
};

/// Measures the share of the visibility tests in the CDT (paper, section 5) in machine instructions, which callgrind
/// counts exactly, on the paper's three models and with its strategies. Without valgrind, rows say so.
ExperimentResult measure_visibility_cost(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult visibility_cost_result(std::span<const VisibilityCostRow> rows);

}  // namespace ccdt::experiments
