#include "reports/claims.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ccdt {
namespace {

PaperClaim claim_of(const std::vector<std::pair<BoundTest, BoundTest>>& outcomes) {
  PaperClaim claim{"id", "6", "A sentence.", {"table1"}};
  claim.weaker = "A weaker one.";
  for (const auto& [strong, weak] : outcomes) {
    claim.measured.push_back({"m" + std::to_string(claim.measured.size()), 1.0, "", strong, weak, "table1", "ratios"});
  }
  judge(claim);
  return claim;
}

constexpr BoundTest yes = BoundTest::holds, open = BoundTest::undecided, no = BoundTest::fails;

TEST(ClaimVerdict, FollowsFromTheMeasuresAlone) {
  EXPECT_EQ(claim_of({}).verdict, ClaimVerdict::not_testable);
  EXPECT_EQ(claim_of({{yes, yes}, {yes, yes}}).verdict, ClaimVerdict::confirmed);
  EXPECT_EQ(claim_of({{yes, yes}, {no, yes}}).verdict, ClaimVerdict::reservation);
  EXPECT_EQ(claim_of({{yes, yes}, {open, yes}}).verdict, ClaimVerdict::reservation);
  EXPECT_EQ(claim_of({{yes, yes}, {open, open}}).verdict, ClaimVerdict::not_testable);
  EXPECT_EQ(claim_of({{yes, yes}, {open, open}, {no, no}}).verdict, ClaimVerdict::refuted);
}

TEST(ClaimVerdict, NamesWhatSpeaksAgainstTheClaim) {
  EXPECT_NE(claim_of({{yes, yes}, {no, no}}).reason.find("m1"), std::string::npos);
  EXPECT_NE(claim_of({{yes, yes}, {no, yes}}).reason.find("A weaker one. Not as the paper has it: m1."),
            std::string::npos);
  EXPECT_NE(claim_of({{open, open}}).reason.find("are too wide: m0"), std::string::npos);
  EXPECT_NE(claim_of({}).reason.find("table1"), std::string::npos);
}

ExperimentResult table1(const Estimate& check, const Estimate& saving) {
  ExperimentResult result{.name = "table1"};
  ResultTable ratios{"ratios",
                     "Ratios",
                     {{"model", "model", ColumnKind::label},
                      {"ratio", "ratio", ColumnKind::label},
                      {"value", "here", ColumnKind::time},
                      {"paper_value", "paper", ColumnKind::paper}}};
  ratios.rows = {{{std::string("piston"), std::string("with check / Delaunay"), check, 1.02}, {"runs/a.json"}},
                 {{std::string("piston"), std::string("without / with check"), saving, 23.2}, {"runs/b.json"}}};
  result.tables = {ratios};
  return result;
}

const PaperClaim& find(const std::vector<PaperClaim>& claims, const std::string& id) {
  const auto found = std::ranges::find(claims, id, &PaperClaim::id);
  if (found == claims.end()) throw std::out_of_range(id);
  return *found;
}

ClaimVerdict verdict_of(const ExperimentResult& result, const std::string& id) {
  return find(judge_claims(std::span(&result, 1)), id).verdict;
}

TEST(TimeClaims, JudgeTheCheckByTheWholeInterval) {
  const Estimate factor{10, 9, 11};
  EXPECT_EQ(verdict_of(table1({1.05, 1.04, 1.06}, factor), "check-costs-little"), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(table1({1.05, 1.04, 1.16}, factor), "check-costs-little"), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1({1.5, 1.4, 1.6}, factor), "check-costs-little"), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1({1.9, 1.7, 2.1}, factor), "check-costs-little"), ClaimVerdict::not_testable);
  EXPECT_EQ(verdict_of(table1({2.5, 2.4, 2.6}, factor), "check-costs-little"), ClaimVerdict::refuted);
}

TEST(TimeClaims, JudgeWhatTheCheckSaves) {
  const Estimate check{1.05, 1.04, 1.06};
  EXPECT_EQ(verdict_of(table1(check, {10, 9, 11}), "check-saves-a-factor"), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(table1(check, {3, 2.9, 3.1}), "check-saves-a-factor"), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(table1(check, {0.9, 0.8, 0.95}), "check-saves-a-factor"), ClaimVerdict::refuted);
}

TEST(Claims, KeepTheRunsBehindTheirMeasures) {
  const ExperimentResult result = table1({1.05, 1.04, 1.06}, {10, 9, 11});
  const auto claims = judge_claims(std::span(&result, 1));
  const PaperClaim& claim = find(claims, "check-costs-little");
  ASSERT_EQ(claim.measured.size(), 1u);
  EXPECT_EQ(claim.measured[0].runs, std::vector<std::string>{"runs/a.json"});
}

TEST(Claims, AreAllNotTestableWithoutExperiments) {
  const auto claims = judge_claims({});
  EXPECT_GE(claims.size(), 10u);
  for (const PaperClaim& claim : claims) {
    EXPECT_EQ(claim.verdict, ClaimVerdict::not_testable) << claim.id;
    EXPECT_FALSE(claim.experiments.empty()) << claim.id;
  }
}

ExperimentResult lattices(double fcc, double bcc) {
  ExperimentResult result{.name = "lattices"};
  ResultTable best{"best",
                   "The best lattice",
                   {{"criterion", "by", ColumnKind::label},
                    {"improved", "improved", ColumnKind::label},
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
  EXPECT_EQ(verdict_of(lattices(3, 0), "fcc-is-best"), ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(lattices(2, 1), "fcc-is-best"), ClaimVerdict::reservation);
  EXPECT_EQ(verdict_of(lattices(1, 2), "fcc-is-best"), ClaimVerdict::refuted);
}

}  // namespace
}  // namespace ccdt
