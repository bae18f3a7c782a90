#include "reports/claims.h"

#include <algorithm>

#include "reports/claims/claim_groups.h"

namespace ccdt::reports {
namespace {

/// The names of the measures for which a form of the claim has this outcome.
std::string names_of_measures(const PaperClaim& claim, BoundTest ClaimMeasure::*form, BoundTest outcome) {
  std::vector<std::string> names;
  for (const ClaimMeasure& m : claim.measured)
    if (m.*form == outcome) names.push_back(m.what);
  constexpr std::size_t most = 4;
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  return joined(names) + (more > 0 ? " and " + std::to_string(more) + " more" : "");
}

/// Does a form of the claim have this outcome for any measure?
bool any(const PaperClaim& claim, BoundTest ClaimMeasure::*form, BoundTest outcome) {
  return std::ranges::find(claim.measured, outcome, form) != claim.measured.end();
}

}  // namespace

std::string_view words_of(ClaimVerdict verdict) {
  for (const NamedValue<ClaimVerdict>& one : names_of(verdict))
    if (one.value == verdict) return one.what;
  return {};
}

void judge(PaperClaim& claim) {
  if (claim.measured.empty()) {
    claim.verdict = ClaimVerdict::not_testable;
    claim.reason = "Nothing was measured: this claim needs " + joined(claim.experiments) + ".";
  } else if (!any(claim, &ClaimMeasure::strong, BoundTest::fails) &&
             !any(claim, &ClaimMeasure::strong, BoundTest::undecided)) {
    claim.verdict = ClaimVerdict::confirmed;
    claim.reason = "All measurements agree with the paper.";
  } else if (any(claim, &ClaimMeasure::weak, BoundTest::fails)) {
    claim.verdict = ClaimVerdict::refuted;
    claim.reason = "Contradicted by: " + names_of_measures(claim, &ClaimMeasure::weak, BoundTest::fails) + ".";
  } else if (any(claim, &ClaimMeasure::weak, BoundTest::undecided)) {
    claim.verdict = ClaimVerdict::not_testable;
    if (any(claim, &ClaimMeasure::strong, BoundTest::fails))
      claim.reason =
          "Different from the paper: " + names_of_measures(claim, &ClaimMeasure::strong, BoundTest::fails) + ". ";
    if (!claim.weaker.empty()) claim.reason += "Not decided even in the weaker form: " + claim.weaker + " ";
    claim.reason += "Undecided: " + names_of_measures(claim, &ClaimMeasure::weak, BoundTest::undecided) +
                    ". More runs or larger models may decide.";
  } else {
    claim.verdict = ClaimVerdict::reservation;
    const BoundTest found =
        any(claim, &ClaimMeasure::strong, BoundTest::fails) ? BoundTest::fails : BoundTest::undecided;
    claim.reason = claim.weaker + (found == BoundTest::fails ? " Different from the paper: " : " Not decided: ") +
                   names_of_measures(claim, &ClaimMeasure::strong, found) + ".";
  }
}

std::vector<PaperClaim> judge_claims(std::span<const ExperimentResult> results) {
  std::vector<PaperClaim> claims;
  for (const auto& group : {time_claims(results), quality_claims(results), existence_claims(results)})
    claims.insert(claims.end(), group.begin(), group.end());
  std::ranges::for_each(claims, [](PaperClaim& claim) { judge(claim); });
  return claims;
}

}  // namespace ccdt::reports
