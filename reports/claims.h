#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/experiment.h"
#include "engine/base/enum_names.h"

namespace ccdt::reports {

using bench::joined;
using bench::rounded;
using bench::with_separators;
using experiments::BoundTest;
using results::Cell, results::ExperimentResult, results::KeptMesh, results::ResultRow, results::ResultTable;

/// The result of testing a claim of the paper.
enum class ClaimVerdict {
  confirmed,    ///< all measurements agree with the claim
  reservation,  ///< a weaker form of the claim holds
  refuted,      ///< a measurement contradicts even the weaker form
  not_testable  ///< nothing was measured, or the intervals are too wide
};

/// Each name as it is in JSON, followed by the text for people.
constexpr auto names_of(ClaimVerdict) {
  return std::to_array<NamedValue<ClaimVerdict>>(
      {{ClaimVerdict::confirmed, "confirmed", "confirmed"},
       {ClaimVerdict::reservation, "confirmed with a reservation", "partly confirmed"},
       {ClaimVerdict::refuted, "refuted", "refuted"},
       {ClaimVerdict::not_testable, "not testable here", "not testable at this scale"}});
}

/// The verdict in words for people.
std::string_view words_of(ClaimVerdict verdict);

/// One number that decides a claim.
struct ClaimMeasure {
  std::string what;                                  ///< for people
  Cell value;                                        ///< with its interval, if there is one
  std::string bound;                                 ///< the bound of the claim, for people
  BoundTest strong = experiments::BoundTest::fails;  ///< does the claim hold as in the paper?
  BoundTest weak = experiments::BoundTest::fails;    ///< does it hold in its weaker form?
  std::string experiment, table;
  std::vector<std::string> runs = {};
};

/// A claim of the paper and its measurements.
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

/// Fills in the verdict and its reason from the measures alone: confirmed if all hold as in the paper, refuted if one
/// fails even in the weaker form, partly confirmed if all hold in the weaker form.
void judge(PaperClaim& claim);

/// All claims, judged by the results of these experiments. A claim whose experiments are missing is not testable.
std::vector<PaperClaim> judge_claims(std::span<const ExperimentResult> results);

}  // namespace ccdt::reports
