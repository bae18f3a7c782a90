#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/quality_experiments.h"

namespace ccdt {
namespace {

/// Is a part of these words in one of the lines?
bool say(const std::vector<std::string>& lines, const std::string& words) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TEST(InteriorPointsFindings, CountTheHarm) {
  experiments::InteriorPoints points;
  points.cases = {
      {{}, "cube", 0.5, Lattice::fcc, experiments::InteriorRule::paper},
      {{}, "cube", 0.5, Lattice::fcc, experiments::InteriorRule::no_spheres},
      {{baselines::RunStatus::failed, "it is open"}, "part.off", 0, Lattice::sc, experiments::InteriorRule::paper}};
  points.cases[0].counts.interior_vertices = 1000;
  points.cases[1].counts.interior_vertices = 1200;
  points.cases[1].counts.dropped_interior_vertices = 3;
  points.existence = {{"segments", 40, 7, {}}};
  const results::ExperimentResult result = experiments::result_of(points);
  EXPECT_TRUE(say(result.findings, "7 of 40 small PLCs"));
  EXPECT_TRUE(say(result.findings, "Rule \"paper\": no point did harm in 1 cases with 1,000 interior vertices"));
  EXPECT_TRUE(say(result.findings, "Rule \"no spheres\": points do harm: 3 points of 1,203"));
  EXPECT_TRUE(say(result.findings, "Rule \"no distances\": no case to judge by"));
  EXPECT_TRUE(say(result.problems, "part.off, sc, paper: failed: it is open"));
  EXPECT_EQ(results::find_table(result, "cases")->rows.size(), 3u);
}

experiments::QualityRow row(const std::string& variant, double mean_r, double worst_r, double dihedral) {
  experiments::QualityRow made;
  made.variant = variant;
  made.is_ours = !variant.starts_with("tetgen") && !variant.starts_with("gmsh");
  made.samples = {0.01, 0.01, 0.01};
  made.seconds = bench::Estimate{0.01, 0.01, 0.01};
  made.counts.tetrahedra = 10000;
  made.quality.r = {1, mean_r, mean_r, 2, worst_r, {{1, 1.1, 1.2, 1000}, {9000, 999, 1}}};
  made.quality.dihedral_degrees = {dihedral, 150, {{0, 5, 10, 180}, {0, 6, 59994}}};
  made.is_comparable = true;
  made.runs = {"runs/a-1.json"};
  return made;
}

template <class Study>
Study study_of(const std::vector<experiments::QualityRow>& rows) {
  Study study;
  experiments::QualityCase c;
  c.name = "part.off";
  c.wanted = 10000;
  c.surface.angles = {{31, {7, 8, 9}}, {12, {1, 2.5, -3}}};
  c.rows = rows;
  study.cases.push_back(c);
  return study;
}

experiments::MesherQuality quality_with(double dihedral) {
  return study_of<experiments::MesherQuality>(
      {row("ccdt fcc", 1.15, 2.5, dihedral), row("tetgen", 1.5, 8, 10), row("gmsh-hxt", 1.4, 4, 17)});
}

TEST(MesherQualityFindings, SayInWhatWeAreBetterThanAllOthers) {
  const results::ExperimentResult result = experiments::result_of(quality_with(16));
  EXPECT_TRUE(say(result.findings, "mean r in 1 of 1"));
  EXPECT_TRUE(say(result.findings, "smallest dihedral in 0 of 1 cases"));
  const results::ResultTable& verdicts = *results::find_table(result, "verdicts");
  ASSERT_EQ(verdicts.rows.size(), 4u);
  EXPECT_EQ(results::text_in(verdicts, verdicts.rows[0], "better"), "yes");
  EXPECT_EQ(results::text_in(verdicts, verdicts.rows[3], "better"), "no");
  EXPECT_EQ(results::text_in(verdicts, verdicts.rows[3], "best_other_variant"), "gmsh-hxt");
}

TEST(MesherQualityFindings, NameFailuresAndUnequalCountsWithTheirReasons) {
  experiments::MesherQuality quality = quality_with(19);
  quality.cases[0].rows[1].status = baselines::RunStatus::crashed;
  quality.cases[0].rows[1].reason = "ended by signal SIGSEGV";
  quality.cases[0].rows[2].is_comparable = false;
  EXPECT_TRUE(experiments::result_of(quality).is_good);
  quality.cases.emplace_back();
  quality.cases[1].name = "open.off";
  quality.cases[1].reason = "the surface is open";
  const results::ExperimentResult result = experiments::result_of(quality);
  EXPECT_FALSE(result.is_good);
  EXPECT_TRUE(say(result.problems, "tetgen: crashed: ended by signal SIGSEGV"));
  EXPECT_TRUE(say(result.problems, "gmsh-hxt: 10,000 tetrahedra are not comparable"));
  EXPECT_TRUE(say(result.problems, "open.off, 0 tetrahedra: the surface is open"));
}

TEST(MesherQualityFindings, HaveTheHistogramsInPercent) {
  const results::ExperimentResult result = experiments::result_of(quality_with(19));
  const results::ResultTable& bins = *results::find_table(result, "r_histogram");
  ASSERT_EQ(bins.rows.size(), 9u);
  EXPECT_EQ(results::number_in(bins, bins.rows[0], "percent"), 90);
  EXPECT_EQ(results::number_in(bins, bins.rows[0], "high"), 1.1);
}

TEST(LatticesFindings, StateThePapersClaimByEachMeasure) {
  const auto findings = [](double fcc_mean) {
    std::vector<experiments::QualityRow> rows;
    for (const std::string suffix : {"", " improved"}) {
      rows.push_back(row("fcc" + suffix, fcc_mean, 3, 20));
      rows.push_back(row("bcc" + suffix, 1.15, 4, 19));
      rows.push_back(row("sc" + suffix, 1.3, 5, 10));
    }
    return experiments::result_of(study_of<experiments::Lattices>(rows)).findings;
  };
  EXPECT_TRUE(say(findings(1.2), "That FCC is best is confirmed after improvement by: worst r, smallest dihedral"));
  EXPECT_TRUE(say(findings(1.2), "That FCC is best is not confirmed before improvement by: mean r"));
  EXPECT_TRUE(say(findings(1.1), "is confirmed before improvement by: mean r"));
}

TEST(ImprovementFindings, CountInHowManyCasesEachIsBest) {
  const results::ExperimentResult result = experiments::result_of(study_of<experiments::ImprovementParts>(
      {row("none", 1.3, 50, 1), row("swap", 1.2, 9, 5), row("all", 1.2, 3, 18)}));
  const results::ResultTable& best = *results::find_table(result, "best");
  std::vector<double> counts;
  for (const results::ResultRow& r : best.rows) counts.push_back(results::number_in(best, r, "best"));
  EXPECT_EQ(counts, (std::vector<double>{0, 1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 1}));
}

TEST(LatticeFitFindings, NameTheBestSettingAndWhetherItIsTheDefault) {
  const auto findings = [](const experiments::LatticeSetting& best) {
    std::vector<experiments::QualityRow> rows;
    for (const experiments::LatticeSetting& setting : experiments::lattice_settings())
      rows.push_back(row(experiments::text_of(setting), 1.2, setting == best ? 2 : 5, 15));
    return experiments::result_of(study_of<experiments::LatticeFit>(rows)).findings;
  };
  EXPECT_TRUE(say(findings(experiments::default_lattice_setting()),
                  "The best setting is " + experiments::text_of(experiments::default_lattice_setting())));
  EXPECT_TRUE(say(findings(experiments::default_lattice_setting()), "It is the default"));
  const experiments::LatticeSetting other = experiments::lattice_settings().front();
  ASSERT_FALSE(other == experiments::default_lattice_setting());
  EXPECT_TRUE(say(findings(other), "The best setting is " + experiments::text_of(other)));
  EXPECT_TRUE(say(findings(other), "The default, " + experiments::text_of(experiments::default_lattice_setting()) +
                                       ", has a mean rank of"));
  EXPECT_TRUE(
      say(experiments::result_of(experiments::LatticeFit()).findings, "no surface on which every setting went well"));
}

}  // namespace
}  // namespace ccdt
