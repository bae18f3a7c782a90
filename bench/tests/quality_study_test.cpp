#include <gtest/gtest.h>

#include <algorithm>

#include "bench/experiments/quality_experiments.h"

namespace ccdt {
namespace {

experiments::QualityRow row(const std::string& variant, double mean_r, double worst_r, double dihedral) {
  experiments::QualityRow made;
  made.variant = variant;
  made.quality.r = {1, mean_r, mean_r, 0.5 * (mean_r + worst_r), worst_r};
  made.quality.dihedral_degrees = {dihedral, 180 - dihedral, {}};
  made.is_comparable = true;
  made.is_ours = variant.starts_with("ccdt");
  return made;
}

TEST(Criteria, KnowWhichWayIsBetter) {
  const bench::Quality quality = row("a", 1.2, 3, 18).quality;
  EXPECT_EQ(experiments::value_of(quality, experiments::Criterion::mean_r), 1.2);
  EXPECT_EQ(experiments::value_of(quality, experiments::Criterion::p99_r), 2.1);
  EXPECT_EQ(experiments::value_of(quality, experiments::Criterion::worst_r), 3);
  EXPECT_EQ(experiments::value_of(quality, experiments::Criterion::smallest_dihedral), 18);
  EXPECT_EQ(experiments::value_of(quality, experiments::Criterion::largest_dihedral), 162);
  for (const experiments::Criterion criterion : experiments::lattice_criteria) {
    EXPECT_EQ(experiments::is_better(criterion, 2, 1), criterion == experiments::Criterion::smallest_dihedral);
    EXPECT_FALSE(experiments::is_better(criterion, 1, 1));
  }
}

TEST(MesherQuality, ComparesWithTheBestOfTheOthersByEachCriterion) {
  experiments::QualityCase c;
  c.rows = {row("ccdt fcc", 1.2, 3, 17), row("ccdt bcc", 1.1, 2, 30), row("tetgen", 1.5, 8, 10),
            row("gmsh-hxt", 1.4, 4, 18)};
  const auto comparisons = experiments::compare_with_others(c, c.rows[0]);
  ASSERT_EQ(comparisons.size(), 4u);
  EXPECT_EQ(comparisons[0].best_variant, "gmsh-hxt");
  EXPECT_EQ(comparisons[0].best, 1.4);
  EXPECT_TRUE(comparisons[0].is_better());
  EXPECT_TRUE(comparisons[2].is_better());
  EXPECT_FALSE(comparisons[3].is_better());  // HXT has the larger smallest angle
  EXPECT_TRUE(experiments::compare_with_others(c, c.rows[1])[3].is_better());
}

TEST(MesherQuality, DoesNotCompareWithOtherCountsOrFailures) {
  experiments::QualityCase c;
  c.rows = {row("ccdt fcc", 1.2, 3, 17), row("tetgen", 1.1, 2, 30), row("cgal-mesh3", 1, 2, 40)};
  c.rows[1].is_comparable = false;
  c.rows[2].status = baselines::RunStatus::crashed;
  const auto comparisons = experiments::compare_with_others(c, c.rows[0]);
  EXPECT_TRUE(comparisons[0].best_variant.empty());
  EXPECT_FALSE(comparisons[0].is_better());
  c.rows[0].status = baselines::RunStatus::failed;
  EXPECT_TRUE(experiments::compare_with_others(c, c.rows[0]).empty());
}

experiments::QualityCase lattices_case(double fcc, double bcc, double sc) {
  experiments::QualityCase c;
  for (const std::string suffix : {"", " improved"}) {
    c.rows.push_back(row("fcc" + suffix, fcc, 2 * fcc, 20));
    c.rows.push_back(row("bcc" + suffix, bcc, 2 * bcc, 20));
    c.rows.push_back(row("sc" + suffix, sc, 2 * sc, 10));
  }
  return c;
}

TEST(Lattices, ConfirmTheClaimOnlyIfFccAloneIsBestInEveryCase) {
  experiments::Lattices lattices;
  lattices.cases = {lattices_case(1.1, 1.2, 1.3), lattices_case(1.15, 1.2, 1.5)};
  EXPECT_TRUE(experiments::lattice_claims(lattices)[0].is_confirmed());
  EXPECT_FALSE(experiments::lattice_claims(lattices)[3].is_confirmed());  // smallest dihedral: a tie with bcc
  EXPECT_EQ(experiments::lattice_claims(lattices)[3].best, (std::array<std::uint64_t, 3>{2, 2, 0}));
  lattices.cases.push_back(lattices_case(1.2, 1.1, 1.3));
  EXPECT_FALSE(experiments::lattice_claims(lattices)[0].is_confirmed());
  EXPECT_EQ(experiments::lattice_claims(lattices)[0].best, (std::array<std::uint64_t, 3>{2, 1, 0}));
  EXPECT_EQ(experiments::lattice_claims(lattices).size(), 2 * experiments::lattice_criteria.size());
}

TEST(Lattices, LeaveOutCasesInWhichOneFailed) {
  experiments::Lattices lattices;
  lattices.cases = {lattices_case(1.1, 1.2, 1.3)};
  lattices.cases[0].rows[5].status = baselines::RunStatus::failed;
  const auto claims = experiments::lattice_claims(lattices);
  EXPECT_EQ(claims.front().cases, 1u);
  EXPECT_EQ(claims.back().cases, 0u);
  EXPECT_FALSE(claims.back().is_confirmed());
}

TEST(LatticeFit, HasTheDefaultAmongItsSettings) {
  const auto settings = experiments::lattice_settings();
  EXPECT_EQ(std::ranges::count(settings, experiments::default_lattice_setting()), 1);
  EXPECT_EQ(experiments::text_of(experiments::LatticeSetting{1.1, 0.5}), "sphere 1.1, clearance 0.5");
}

TEST(LatticeFit, RanksSettingsOverAllCases) {
  experiments::LatticeFit fit;
  fit.cases.resize(2);
  const auto settings = experiments::lattice_settings();
  for (experiments::QualityCase& c : fit.cases)
    for (std::size_t i = 0; i < settings.size(); ++i)
      c.rows.push_back(row(experiments::text_of(settings[i]), 1.2, i == 3 ? 2 : 8, i == 3 ? 20 : 10));
  auto summaries = experiments::summarize(fit);
  ASSERT_EQ(summaries.size(), settings.size());
  const double n = static_cast<double>(settings.size());
  // Best alone in p99, worst r and the angle, tied with all in mean r.
  EXPECT_NEAR(summaries[3].rank, (3 + (n + 1) / 2) / 4, 1e-12);
  EXPECT_NEAR(summaries[0].rank, (3 * (n + 2) / 2 + (n + 1) / 2) / 4, 1e-12);
  EXPECT_NEAR(summaries[3].worst_r, 2, 1e-12);
  fit.cases[0].rows[0].status = baselines::RunStatus::failed;
  fit.cases[1].rows[0].quality.r.max = 32;
  summaries = experiments::summarize(fit);  // of the second case alone
  EXPECT_NEAR(summaries[0].worst_r, 32, 1e-12);
  fit.cases.pop_back();
  EXPECT_TRUE(experiments::summarize(fit).empty());
}

}  // namespace
}  // namespace ccdt
