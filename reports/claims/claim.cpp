#include "reports/claims/claim.h"

#include <algorithm>

namespace ccdt {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What the measures are of for which a form of the claim came out so.
std::string those_that(const PaperClaim& claim, Claim ClaimMeasure::*form, Claim outcome) {
  std::vector<std::string> names;
  for (const ClaimMeasure& m : claim.measured)
    if (m.*form == outcome) names.push_back(m.what);
  constexpr std::size_t most = 4;
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  return joined(names) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

bool all(const PaperClaim& claim, Claim ClaimMeasure::*form, Claim outcome) {
  return std::ranges::all_of(claim.measured, [&](const ClaimMeasure& m) { return m.*form == outcome; });
}

bool any(const PaperClaim& claim, Claim ClaimMeasure::*form, Claim outcome) {
  return std::ranges::any_of(claim.measured, [&](const ClaimMeasure& m) { return m.*form == outcome; });
}

}  // namespace

std::string_view name_of(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::confirmed:
      return "confirmed";
    case ClaimVerdict::reservation:
      return "confirmed with a reservation";
    case ClaimVerdict::refuted:
      return "refuted";
    case ClaimVerdict::not_testable:
      return "not testable here";
  }
  return "";
}

void judge(PaperClaim& claim) {
  if (claim.measured.empty()) {
    claim.verdict = ClaimVerdict::not_testable;
    claim.reason = "Nothing was measured: it takes " + joined(claim.experiments) + ".";
  } else if (all(claim, &ClaimMeasure::strong, Claim::holds)) {
    claim.verdict = ClaimVerdict::confirmed;
    claim.reason = "All that was measured is as the paper says.";
  } else if (any(claim, &ClaimMeasure::weak, Claim::fails)) {
    claim.verdict = ClaimVerdict::refuted;
    claim.reason = "Contradicted by: " + those_that(claim, &ClaimMeasure::weak, Claim::fails) + ".";
  } else if (!all(claim, &ClaimMeasure::weak, Claim::holds)) {
    claim.verdict = ClaimVerdict::not_testable;
    if (any(claim, &ClaimMeasure::strong, Claim::fails))
      claim.reason = "Not as the paper has it: " + those_that(claim, &ClaimMeasure::strong, Claim::fails) + ". ";
    claim.reason += (claim.weaker.empty() ? "The" : "For the weaker form (" + claim.weaker + ") the") +
                    std::string(" intervals are too wide: ") +
                    those_that(claim, &ClaimMeasure::weak, Claim::undecided) +
                    ". More runs or larger models narrow them.";
  } else {
    claim.verdict = ClaimVerdict::reservation;
    claim.reason = claim.weaker + " Not as the paper has it: " + those_that(claim, &ClaimMeasure::strong, Claim::fails);
    const std::string open = those_that(claim, &ClaimMeasure::strong, Claim::undecided);
    if (!any(claim, &ClaimMeasure::strong, Claim::fails)) claim.reason = claim.weaker + " Not decided: " + open;
    claim.reason += ".";
  }
}

ClaimMeasure yes_or_no(std::string what, Cell value, std::string bound, bool holds) {
  const Claim outcome = holds ? Claim::holds : Claim::fails;
  return {std::move(what), std::move(value), std::move(bound), outcome, outcome, "", ""};
}

const ResultTable* find_table(std::span<const ExperimentResult> results, std::string_view experiment,
                              std::string_view table) {
  const auto found = std::ranges::find(results, experiment, &ExperimentResult::name);
  return found == results.end() ? nullptr : find_table(*found, table);
}

std::vector<PaperClaim> judge_claims(std::span<const ExperimentResult> results) {
  std::vector<PaperClaim> claims;
  add_time_claims(results, claims);
  add_quality_claims(results, claims);
  add_existence_claims(results, claims);
  std::ranges::for_each(claims, [](PaperClaim& claim) { judge(claim); });
  return claims;
}

}  // namespace ccdt
