#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "reports/claims.h"

namespace ccdt {
namespace {

using reports::ClaimVerdict;

ClaimVerdict verdict_on(const results::ExperimentResult& result, const std::string& id) {
  const auto claims = reports::judge_claims(std::span(&result, 1));
  const auto found = std::ranges::find(claims, id, &reports::PaperClaim::id);
  if (found == claims.end()) throw std::out_of_range(id);
  return found->verdict;
}

/// The number of cases where a conforming tetrahedralization needs vertices, and of those where ours needs fewer or
/// more.
struct Counts {
  double needed, fewer, more;
};

results::ExperimentResult conforming(const Counts& midpoint, const Counts& shell) {
  results::ExperimentResult result{.name = "conforming"};
  results::ResultTable comparison{"comparison",
                                  "Steiner vertices",
                                  {{"protection", "protection", results::ColumnKind::label},
                                   {"needed", "needed"},
                                   {"fewer", "fewer"},
                                   {"more", "more"}}};
  comparison.rows = {{{std::string("midpoint"), midpoint.needed, midpoint.fewer, midpoint.more}},
                     {{std::string("shell"), shell.needed, shell.fewer, shell.more}}};
  result.tables = {comparison};
  return result;
}

TEST(ExistenceClaims, WantFewerVerticesThanAConformingOneOnEveryInput) {
  const auto verdict = [](const Counts& midpoint, const Counts& shell) {
    return verdict_on(conforming(midpoint, shell), "fewer-vertices-than-conforming");
  };
  EXPECT_EQ(verdict({5, 5, 0}, {4, 4, 0}), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict({5, 4, 0}, {4, 4, 0}), ClaimVerdict::reservation);
  EXPECT_EQ(verdict({5, 5, 0}, {4, 3, 0}), ClaimVerdict::reservation);
  EXPECT_EQ(verdict({5, 4, 1}, {4, 4, 0}), ClaimVerdict::refuted);
  EXPECT_EQ(verdict({5, 5, 0}, {4, 4, 1}), ClaimVerdict::refuted);
  EXPECT_EQ(verdict({0, 0, 0}, {0, 0, 0}), ClaimVerdict::not_testable);
}

/// Models, and those that fulfill the condition of Radovitzky and Ortiz, Theorem 1's, and only the first one.
struct Fulfilled {
  double models, theirs, theorem, only_theirs;
};

ClaimVerdict verdict_on_conditions(const Fulfilled& all) {
  results::ExperimentResult result{.name = "conditions"};
  results::ResultTable models{"models",
                              "Models",
                              {{"lattice", "lattice", results::ColumnKind::label},
                               {"models", "models"},
                               {"theirs", "theirs"},
                               {"theorem", "theorem"},
                               {"only_theirs", "only theirs"}}};
  models.rows = {{{std::string("none"), 1.0, 1.0, 0.0, 1.0}},
                 {{std::string("all"), all.models, all.theirs, all.theorem, all.only_theirs}}};
  result.tables = {models};
  return verdict_on(result, "weaker-condition-than-radovitzky");
}

TEST(ExistenceClaims, WantTheoremOneToHoldForMoreModelsThanRadovitzkysCondition) {
  EXPECT_EQ(verdict_on_conditions({10, 3, 7, 0}), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_on_conditions({10, 5, 7, 0}), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_on_conditions({10, 6, 7, 0}), ClaimVerdict::reservation);  // not few
  EXPECT_EQ(verdict_on_conditions({10, 3, 3, 0}), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_on_conditions({10, 3, 7, 1}), ClaimVerdict::refuted);
}

}  // namespace
}  // namespace ccdt
