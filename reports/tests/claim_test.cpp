#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "reports/claims.h"

namespace ccdt {
namespace {

reports::PaperClaim claim_of(const std::vector<std::pair<experiments::BoundTest, experiments::BoundTest>>& outcomes) {
  reports::PaperClaim claim{"id", "6", "A sentence.", {"table1"}};
  claim.weaker = "A weaker one.";
  for (const auto& [strong, weak] : outcomes) {
    claim.measured.push_back({"m" + std::to_string(claim.measured.size()), 1.0, "", strong, weak, "table1", "ratios"});
  }
  reports::judge(claim);
  return claim;
}

constexpr experiments::BoundTest yes = experiments::BoundTest::holds, open = experiments::BoundTest::undecided,
                                 no = experiments::BoundTest::fails;

TEST(ClaimVerdict, FollowsFromTheMeasuresAlone) {
  EXPECT_EQ(claim_of({}).verdict, reports::ClaimVerdict::not_testable);
  EXPECT_EQ(claim_of({{yes, yes}, {yes, yes}}).verdict, reports::ClaimVerdict::confirmed);
  EXPECT_EQ(claim_of({{yes, yes}, {no, yes}}).verdict, reports::ClaimVerdict::reservation);
  EXPECT_EQ(claim_of({{yes, yes}, {open, yes}}).verdict, reports::ClaimVerdict::reservation);
  EXPECT_EQ(claim_of({{yes, yes}, {open, open}}).verdict, reports::ClaimVerdict::not_testable);
  EXPECT_EQ(claim_of({{yes, yes}, {open, open}, {no, no}}).verdict, reports::ClaimVerdict::refuted);
}

TEST(ClaimVerdict, NamesWhatSpeaksAgainstTheClaim) {
  EXPECT_NE(claim_of({{yes, yes}, {no, no}}).reason.find("m1"), std::string::npos);
  const std::string weaker = claim_of({{yes, yes}, {no, yes}}).reason;
  EXPECT_NE(weaker.find("A weaker one."), std::string::npos);
  EXPECT_NE(weaker.find("m1"), std::string::npos);
  EXPECT_EQ(weaker.find("m0"), std::string::npos);
  EXPECT_NE(claim_of({{open, open}}).reason.find("m0"), std::string::npos);
  EXPECT_NE(claim_of({}).reason.find("table1"), std::string::npos);
}

results::ExperimentResult table1(const bench::Estimate& check, const bench::Estimate& saving) {
  results::ExperimentResult result{.name = "table1"};
  results::ResultTable ratios{"ratios",
                              "Ratios",
                              {{"model", "model", results::ColumnKind::label},
                               {"ratio", "ratio", results::ColumnKind::label},
                               {"value", "here", results::ColumnKind::time},
                               {"paper_value", "paper", results::ColumnKind::paper}}};
  ratios.rows = {{{std::string("piston"), std::string("with check / Delaunay"), check, 1.02}, {"runs/a.json"}},
                 {{std::string("piston"), std::string("without / with check"), saving, 23.2}, {"runs/b.json"}}};
  result.tables = {ratios};
  return result;
}

const reports::PaperClaim& find(const std::vector<reports::PaperClaim>& claims, const std::string& id) {
  const auto found = std::ranges::find(claims, id, &reports::PaperClaim::id);
  if (found == claims.end()) throw std::out_of_range(id);
  return *found;
}

reports::ClaimVerdict verdict_of(const results::ExperimentResult& result, const std::string& id) {
  return find(reports::judge_claims(std::span(&result, 1)), id).verdict;
}

TEST(TimeClaims, JudgeTheCheckByTheWholeInterval) {
  const bench::Estimate factor{10, 9, 11};
  EXPECT_EQ(verdict_of(table1({1.05, 1.04, 1.06}, factor), "check-costs-little"), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(table1({1.05, 1.04, 1.16}, factor), "check-costs-little"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1({1.5, 1.4, 1.6}, factor), "check-costs-little"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1({1.9, 1.7, 2.1}, factor), "check-costs-little"), reports::ClaimVerdict::not_testable);
  EXPECT_EQ(verdict_of(table1({2.5, 2.4, 2.6}, factor), "check-costs-little"), reports::ClaimVerdict::refuted);
}

TEST(TimeClaims, JudgeWhatTheCheckSaves) {
  const bench::Estimate check{1.05, 1.04, 1.06};
  EXPECT_EQ(verdict_of(table1(check, {10, 9, 11}), "check-saves-a-factor"), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(table1(check, {3, 2.9, 3.1}), "check-saves-a-factor"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1(check, {0.9, 0.8, 0.95}), "check-saves-a-factor"), reports::ClaimVerdict::refuted);
}

TEST(Claims, KeepTheRunsBehindTheirMeasures) {
  const results::ExperimentResult result = table1({1.05, 1.04, 1.06}, {10, 9, 11});
  const auto claims = reports::judge_claims(std::span(&result, 1));
  const reports::PaperClaim& claim = find(claims, "check-costs-little");
  ASSERT_EQ(claim.measured.size(), 1u);
  EXPECT_EQ(claim.measured[0].runs, std::vector<std::string>{"runs/a.json"});
}

TEST(Claims, AreAllNotTestableWithoutExperiments) {
  const auto claims = reports::judge_claims({});
  EXPECT_GE(claims.size(), 10u);
  for (const reports::PaperClaim& claim : claims) {
    EXPECT_EQ(claim.verdict, reports::ClaimVerdict::not_testable) << claim.id;
    EXPECT_FALSE(claim.experiments.empty()) << claim.id;
  }
}

/// The criteria of the unit cells by which FCC alone is the best.
results::ExperimentResult lattices(const std::vector<std::string>& best_by) {
  results::ExperimentResult result{.name = "lattices"};
  results::ResultTable criteria{"unit_cell_criteria",
                                "The best unit cell",
                                {{"criterion", "by", results::ColumnKind::label},
                                 {"confirmed", "FCC alone is the best"},
                                 {"fcc", "FCC"},
                                 {"best_other", "best of the others"},
                                 {"best_other_lattices", "of"}}};
  for (const std::string criterion : {"mean r", "worst r", "smallest dihedral"}) {
    const bool is_best = std::ranges::find(best_by, criterion) != best_by.end();
    criteria.rows.push_back(
        {{criterion, std::string(is_best ? "yes" : "no"), 1.1, 1.2, std::string("body-centered cubic")}, {}});
  }
  result.tables = {criteria};
  return result;
}

TEST(QualityClaims, JudgeFccByItsUnitCell) {
  EXPECT_EQ(verdict_of(lattices({"mean r", "worst r", "smallest dihedral"}), "fcc-is-best"),
            reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(lattices({"mean r"}), "fcc-is-best"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(lattices({"worst r"}), "fcc-is-best"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(lattices({"smallest dihedral"}), "fcc-is-best"), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict_of(lattices({}), "fcc-is-best"), reports::ClaimVerdict::refuted);
}

}  // namespace
}  // namespace ccdt
