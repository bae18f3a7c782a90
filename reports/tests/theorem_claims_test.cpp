#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reports/claims.h"

namespace ccdt {
namespace {

using reports::ClaimVerdict;

/// A table with these columns; the first ones are texts.
results::ResultTable made_up_table(const std::string& name, std::size_t texts, const std::vector<std::string>& columns,
                                   const std::vector<std::vector<results::Cell>>& rows) {
  results::ResultTable table{name, name, {}};
  for (std::size_t i = 0; i < columns.size(); ++i)
    table.columns.push_back(
        {columns[i], columns[i], i < texts ? results::ColumnKind::label : results::ColumnKind::figure});
  for (const auto& cells : rows) table.rows.push_back({cells, {"runs/a.json"}});
  return table;
}

ClaimVerdict verdict_from(const std::string& experiment, const std::vector<results::ResultTable>& tables,
                          const std::string& id) {
  results::ExperimentResult result{.name = experiment};
  result.tables = tables;
  const auto claims = reports::judge_claims(std::span(&result, 1));
  return std::ranges::find(claims, id, &reports::PaperClaim::id)->verdict;
}

/// How many PLCs of each kind were found in a family.
struct FamilyCounts {
  double against_if = 0, against_only_if = 0, without_cdt = 0;
  double cases = 10;
  std::string position = "general";
};

ClaimVerdict theorem_verdict(const std::vector<FamilyCounts>& families, const std::string& id) {
  std::vector<std::vector<results::Cell>> rows;
  for (const FamilyCounts& f : families)
    rows.push_back(
        {std::string("family"), f.position, f.cases, f.against_if, f.cases, f.against_only_if, f.cases, f.without_cdt});
  return verdict_from("theorem1",
                      {made_up_table("families", 2,
                                     {"family", "position", "premise", "against_if", "dt", "against_only_if",
                                      "edge_protected", "edge_protected_without_cdt"},
                                     rows)},
                      id);
}

TEST(TheoremClaims, AreEachRefutedByTheirOwnCounterexamples) {
  const std::vector<std::string> ids = {"theorem-1-if", "theorem-1-only-if", "edge-protection-suffices"};
  const std::vector<FamilyCounts> one_each = {{.against_if = 1}, {.against_only_if = 1}, {.without_cdt = 1}};
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (std::size_t k = 0; k < one_each.size(); ++k)
      EXPECT_EQ(theorem_verdict({{}, one_each[k]}, ids[i]), i == k ? ClaimVerdict::refuted : ClaimVerdict::confirmed)
          << ids[i] << " " << k;
}

TEST(TheoremClaims, DoNotCountFamiliesThatSayNothing) {
  EXPECT_EQ(theorem_verdict({{.cases = 0}}, "theorem-1-if"), ClaimVerdict::not_testable);
  EXPECT_EQ(theorem_verdict({{.against_if = 1, .position = "special"}, {}}, "theorem-1-if"), ClaimVerdict::confirmed);
}

/// \param outcomes  of splitting solids at midpoints
/// \param of_stars  how many of ten segments ended, for each row of a star
ClaimVerdict midpoints_verdict(const std::vector<std::string>& outcomes, const std::vector<double>& of_stars = {}) {
  std::vector<std::vector<results::Cell>> solids, stars;
  for (const std::string& outcome : outcomes) {
    solids.push_back({std::string("solid"), std::string("midpoint"), outcome});
    solids.push_back({std::string("solid"), std::string("shell"), std::string("yes")});
  }
  for (const double ended : of_stars) stars.push_back({std::string("star"), 10.0, ended});
  return verdict_from("termination",
                      {made_up_table("solids", 3, {"model", "protection", "ended"}, solids),
                       made_up_table("stars", 1, {"star", "cases", "midpoint_ended"}, stars)},
                      "midpoints-end");
}

TEST(TerminationClaim, NeedsMidpointsToEndForAllInputs) {
  EXPECT_EQ(midpoints_verdict({"yes", "yes"}), ClaimVerdict::confirmed);
  EXPECT_EQ(midpoints_verdict({"yes", "no"}), ClaimVerdict::refuted);
  EXPECT_EQ(midpoints_verdict({"yes", "time"}), ClaimVerdict::confirmed) << "one without an outcome";
  EXPECT_EQ(midpoints_verdict({}), ClaimVerdict::not_testable);
  EXPECT_EQ(midpoints_verdict({"yes"}, {10, 10}), ClaimVerdict::confirmed);
  EXPECT_EQ(midpoints_verdict({"yes"}, {10, 9}), ClaimVerdict::refuted);
}

ClaimVerdict interior_points_verdict(double lost, double harmed) {
  return verdict_from(
      "interior-points",
      {made_up_table("existence", 1, {"family", "cases", "lost"}, {{std::string("family"), 10.0, lost}}),
       made_up_table("rules", 2, {"rule", "lattice", "cases", "harmed"},
                     {{std::string("rule"), std::string("all"), 10.0, harmed},
                      {std::string("rule"), std::string("fcc"), 10.0, 5.0}})},
      "interior-points-harmless");
}

TEST(InteriorPointsClaim, IsRefutedByOnePointThatDoesHarm) {
  EXPECT_EQ(interior_points_verdict(0, 0), ClaimVerdict::confirmed) << "only the row of all lattices counts";
  EXPECT_EQ(interior_points_verdict(1, 0), ClaimVerdict::refuted);
  EXPECT_EQ(interior_points_verdict(0, 1), ClaimVerdict::refuted);
}

}  // namespace
}  // namespace ccdt
