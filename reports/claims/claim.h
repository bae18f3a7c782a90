#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/experiment.h"

namespace ccdt {

/// What came of testing a claim of the paper.
enum class ClaimVerdict {
  confirmed,    ///< all that was measured is as the claim says
  reservation,  ///< it holds in a weaker form
  refuted,      ///< something that was measured contradicts even that
  not_testable  ///< nothing was measured, or the intervals do not tell
};
std::string_view name_of(ClaimVerdict verdict);

/// One number that a claim stands or falls with.
struct ClaimMeasure {
  std::string what;             ///< for people
  Cell value;                   ///< with its interval, if it has one
  std::string bound;            ///< what the claim asks of it, for people
  Claim strong = Claim::fails;  ///< does it hold as the paper has it?
  Claim weak = Claim::fails;    ///< and in its weaker form?
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

/// The same answer for both forms of a measure that is a yes or a no.
ClaimMeasure yes_or_no(std::string what, Cell value, std::string bound, bool holds);

/// The groups of claims, one a file. Each adds its own; measures of experiments that are missing are left out.
void add_time_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims);
void add_quality_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims);
void add_existence_claims(std::span<const ExperimentResult> results, std::vector<PaperClaim>& claims);

/// Null if the experiment or its table is missing.
const ResultTable* find_table(std::span<const ExperimentResult> results, std::string_view experiment,
                              std::string_view table);

}  // namespace ccdt
