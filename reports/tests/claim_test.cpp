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
  const std::string refuted = claim_of({{yes, yes}, {no, no}}).reason;
  EXPECT_NE(refuted.find("m1"), std::string::npos);
  EXPECT_EQ(refuted.find("m0"), std::string::npos);
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

/// A fit of Fig. 8.
struct MadeUpFit {
  std::string strategy, quantity;
  bench::Estimate exponent;
  bool is_judged = true;
};

/// All fits have this exponent, except those in `others`.
results::ExperimentResult fig8(const std::vector<MadeUpFit>& others,
                               const bench::Estimate& exponent = {1, 0.99, 1.01}) {
  const std::vector<results::Column> columns = {
      {"model", "model", results::ColumnKind::label},        {"strategy", "strategy", results::ColumnKind::label},
      {"quantity", "of", results::ColumnKind::label},        {"exponent", "exponent", results::ColumnKind::time},
      {"better", "n or n log n", results::ColumnKind::note}, {"judged", "judged", results::ColumnKind::label},
      {"why_not", "why not", results::ColumnKind::note}};
  results::ResultTable work{"work", "Work", columns}, fits{"fits", "Fits", columns};
  const auto add = [&](const std::string& strategy, const std::string& quantity, results::ResultTable& table) {
    MadeUpFit fit{strategy, quantity, exponent};
    for (const MadeUpFit& other : others)
      if (other.strategy == strategy && other.quantity == quantity) fit = other;
    table.rows.push_back({{std::string("bracket"), strategy, quantity, fit.exponent, std::string("n"),
                           std::string(fit.is_judged ? "yes" : "no"), std::string(fit.is_judged ? "" : "too short")},
                          {}});
  };
  for (const char* strategy : {"paper, with check", "paper, without check"}) {
    for (const char* quantity : {"Delaunay: vertices examined", "Delaunay: grid cells", "front: candidates",
                                 "front: visibility tests", "front: grid cells"})
      add(strategy, quantity, work);
    for (const char* quantity : {"cdt", "delaunay", "front"}) add(strategy, quantity, fits);
  }
  add("Delaunay refinement, ours", "mesh", fits);
  results::ExperimentResult result{.name = "fig8"};
  result.tables = {work, fits};
  return result;
}

TEST(GrowthClaims, NeedWorkAndTimeThatAreBothLinear) {
  const std::string paper = "paper, with check";
  const auto verdict = [&](const std::vector<MadeUpFit>& fits) { return verdict_of(fig8(fits), "linear-with-check"); };
  EXPECT_EQ(verdict({}), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict({{paper, "cdt", {1.15, 1.11, 1.19}}}), reports::ClaimVerdict::reservation);
  EXPECT_EQ(verdict({{paper, "cdt", {0.8, 0.7, 0.89}}}), reports::ClaimVerdict::reservation) << "slower than linear";
  EXPECT_EQ(verdict({{paper, "Delaunay: grid cells", {1.3, 1.25, 1.4}}}), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict({{paper, "cdt", {1.3, 1.25, 1.4}}}), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict({{paper, "cdt", {1.2, 1.1, 1.3}}}), reports::ClaimVerdict::not_testable);
}

TEST(GrowthClaims, HoldWithReservationsWhereWorkIsNearlyLinear) {
  EXPECT_EQ(verdict_of(fig8({{"paper, with check", "Delaunay: grid cells", {1.15, 1.12, 1.18}}}), "linear-with-check"),
            reports::ClaimVerdict::reservation);
}

TEST(GrowthClaims, AreNotTestableWithoutAFitThatIsJudged) {
  const std::string paper = "paper, with check";
  const auto verdict = [&](const std::string& quantity) {
    return verdict_of(fig8({{paper, quantity, {1, 0.99, 1.01}, false}}), "linear-with-check");
  };
  EXPECT_EQ(verdict("cdt"), reports::ClaimVerdict::not_testable);
  EXPECT_EQ(verdict("Delaunay: grid cells"), reports::ClaimVerdict::not_testable);
  EXPECT_EQ(verdict("front"), reports::ClaimVerdict::confirmed) << "another claim needs that";
}

TEST(GrowthClaims, AreEachAboutTheirOwnStage) {
  const std::string without = "paper, without check";
  const auto result = fig8({{without, "front", {1.3, 1.25, 1.4}}, {"paper, with check", "delaunay", {1.4, 1.3, 1.5}}});
  EXPECT_EQ(verdict_of(result, "constant-time-front"), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict_of(result, "linear-grid-delaunay"), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict_of(result, "linear-without-check"), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict_of(fig8({{without, "front: candidates", {1.3, 1.25, 1.4}}}), "linear-without-check"),
            reports::ClaimVerdict::refuted);
}

TEST(GrowthClaims, ExpectRefinementToBeSteeper) {
  const auto verdict = [](const bench::Estimate& exponent) {
    return verdict_of(fig8({{"Delaunay refinement, ours", "mesh", exponent}}), "refinement-is-not-linear");
  };
  EXPECT_EQ(verdict({1.3, 1.2, 1.4}), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict({1.05, 1, 1.09}), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict({1.1, 1, 1.2}), reports::ClaimVerdict::not_testable);
}

TEST(GrowthClaims, AskTetGenTooIfItWasMeasured) {
  results::ExperimentResult result = fig8({{"Delaunay refinement, ours", "mesh", {1.3, 1.2, 1.4}}});
  EXPECT_EQ(verdict_of(result, "refinement-is-not-linear"), reports::ClaimVerdict::confirmed);
  result.tables[1].rows.push_back(
      {{std::string("bracket"), std::string("TetGen, its own vertices"), std::string("mesh"),
        bench::Estimate{1, 0.99, 1.01}, std::string("n"), std::string("yes")},
       {}});
  EXPECT_EQ(verdict_of(result, "refinement-is-not-linear"), reports::ClaimVerdict::refuted);
}

/// The quality of the piston's meshes: the paper's and a rival's.
results::ExperimentResult fig9(double ours, double theirs, bool is_comparable = true, double their_worst = 9) {
  results::ResultTable quality{"quality",
                               "Quality",
                               {{"model", "model", results::ColumnKind::label},
                                {"variant", "variant", results::ColumnKind::label},
                                {"status", "status", results::ColumnKind::label},
                                {"comparable", "comparable"},
                                {"mean_r", "mean r"},
                                {"p99_r", "99% of r below"},
                                {"worst_r", "worst r"},
                                {"smallest_dihedral", "smallest dihedral angle"}}};
  const auto add = [&](const std::string& variant, double mean, double worst, bool comparable) {
    quality.rows.push_back({{std::string("piston"), variant, std::string("ok"), std::string(comparable ? "yes" : "no"),
                             mean, mean + 1, worst, 30 - worst},
                            {"runs/a.json"}});
  };
  add("paper fcc", ours, 5, true);
  add("refinement", theirs, their_worst, is_comparable);
  results::ExperimentResult result{.name = "fig9"};
  result.tables = {quality};
  return result;
}

TEST(QualityClaims, CompareThePapersMeshWithRefinementOfAsManyTetrahedra) {
  const auto verdict = [](const results::ExperimentResult& result) {
    return verdict_of(result, "better-than-refinement");
  };
  EXPECT_EQ(verdict(fig9(1.2, 1.3)), reports::ClaimVerdict::confirmed);
  EXPECT_EQ(verdict(fig9(1.2, 1.3, true, 4)), reports::ClaimVerdict::reservation) << "only its worst r is worse";
  EXPECT_EQ(verdict(fig9(1.3, 1.2)), reports::ClaimVerdict::refuted);
  EXPECT_EQ(verdict(fig9(1.2, 1.3, false)), reports::ClaimVerdict::not_testable) << "the numbers differ";
}

TEST(QualityClaims, LeaveNoFigureOutInSilence) {
  std::vector<results::ExperimentResult> figures = {fig9(1.2, 1.3), fig9(1.2, 1.3)};
  figures[1].name = "fig11";
  const auto claims_of = [&] { return reports::judge_claims(figures); };
  EXPECT_EQ(find(claims_of(), "better-than-refinement").verdict, reports::ClaimVerdict::confirmed);
  figures[1] = fig9(1.2, 1.3, false);
  figures[1].name = "fig11";
  const auto claims = claims_of();
  const reports::PaperClaim& claim = find(claims, "better-than-refinement");
  EXPECT_EQ(claim.verdict, reports::ClaimVerdict::not_testable);
  EXPECT_NE(claim.reason.find("fig11"), std::string::npos) << claim.reason;
}

TEST(QualityClaims, CompareWithTetGenTooIfItWasMeasured) {
  results::ExperimentResult result = fig9(1.2, 1.3);
  results::ResultRow tetgen = result.tables[0].rows[1];
  tetgen.cells[1] = std::string("tetgen");
  tetgen.cells[4] = 1.1;  // its mean r
  result.tables[0].rows.push_back(tetgen);
  EXPECT_EQ(verdict_of(result, "better-than-refinement"), reports::ClaimVerdict::refuted);
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
