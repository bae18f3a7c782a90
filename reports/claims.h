#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "engine/base/enum_names.h"

namespace ccdt::reports {

using experiments::BoundTest;
using results::Cell;
using results::ExperimentResult;
using results::joined;
using results::KeptMesh;
using results::ResultRow;
using results::ResultTable;
using results::rounded;
using results::with_separators;

/// The result of testing a claim of the paper.
enum class ClaimVerdict {
  confirmed,    ///< all that was measured is as the claim says
  reservation,  ///< it holds in a weaker form
  refuted,      ///< something that was measured contradicts even that
  not_testable  ///< nothing was measured, or the intervals do not tell
};

constexpr auto names_of(ClaimVerdict) {
  return std::to_array<NamedValue<ClaimVerdict>>({{ClaimVerdict::confirmed, "confirmed"},
                                                  {ClaimVerdict::reservation, "confirmed with a reservation"},
                                                  {ClaimVerdict::refuted, "refuted"},
                                                  {ClaimVerdict::not_testable, "not testable here"}});
}

/// One number that a claim stands or falls with.
struct ClaimMeasure {
  std::string what;                                  ///< for people
  Cell value;                                        ///< with its interval, if it has one
  std::string bound;                                 ///< what the claim asks of it, for people
  BoundTest strong = experiments::BoundTest::fails;  ///< does it hold as the paper has it?
  BoundTest weak = experiments::BoundTest::fails;    ///< and in its weaker form?
  std::string experiment, table;
  std::vector<std::string> runs = {};
};

/// A claim of the paper and what was measured of it.
struct PaperClaim {
  std::string id;
  std::string section;                   ///< of the paper
  std::string sentence;                  ///< in our words
  std::vector<std::string> experiments;  ///< that measure it
  std::vector<ClaimMeasure> measured = {};
  std::string weaker = {};  ///< the weaker form in words; empty: there is none
  ClaimVerdict verdict = ClaimVerdict::not_testable;
  std::string reason = {};
};

/// Fills in the verdict and its reason, from the measures alone: confirmed if all hold as the paper has them, refuted
/// if one fails even in the weaker form, with a reservation if all hold in that.
void judge(PaperClaim& claim);

/// All claims, judged by what these experiments found. A claim whose experiments are missing is not testable here.
std::vector<PaperClaim> judge_claims(std::span<const ExperimentResult> results);

}  // namespace ccdt::reports
