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

results::ExperimentResult lattices(double fcc, double bcc) {
  results::ExperimentResult result{.name = "lattices"};
  results::ResultTable best{"best",
                            "The best lattice",
                            {{"criterion", "by", results::ColumnKind::label},
                             {"improved", "improved", results::ColumnKind::label},
                             {"confirmed", "confirmed"},
                             {"cases", "cases"},
                             {"fcc", "FCC"},
                             {"bcc", "BCC"},
                             {"sc", "SC"}}};
  const std::string confirmed = fcc == 3 && bcc == 0 ? "yes" : "no";
  best.rows = {{{std::string("mean r"), std::string("no"), confirmed, 3.0, fcc, bcc, 0.0}, {}}};
  result.tables = {best};
  return result;
}

TEST(QualityClaims, JudgeFccByTheCasesInWhichItIsTheBest) {
  EXPECT_EQ(verdict_of(lattices(3, 0), "fcc-is-best"), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(lattices(2, 1), "fcc-is-best"), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(lattices(1, 2), "fcc-is-best"), reports::ClaimVerdict::refuted);
}

}  // namespace
}  // namespace ccdt
