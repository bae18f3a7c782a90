#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reports/ablation_report.h"
#include "reports/lattice_fit_report.h"
#include "reports/lattices_report.h"
#include "reports/mesher_quality_report.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

QualityRow row(const std::string& variant, double mean_r, double worst_r, double dihedral) {
  QualityRow made;
  made.variant = variant;
  made.samples = {0.01, 0.01, 0.01, 0.01, 0.01};
  made.seconds = Estimate{0.01, 0.01, 0.01};
  made.improve_seconds = 0.004;
  made.counts.tetrahedra = 10000;
  made.quality.r = {1, mean_r, mean_r, 2, worst_r, {{1, 1.1, 1.2, 1000}, {9000, 999, 1}}};
  made.quality.dihedral_degrees = {dihedral, 150, {{0, 5, 10, 180}, {0, 6, 59994}}};
  made.is_comparable = true;
  return made;
}

template <class Study>
Study study_of(const std::vector<QualityRow>& rows) {
  Study study;
  study.how.runs = 5;
  QualityCase c;
  c.name = "part.off";
  c.wanted = 10000;
  c.surface.edge_length = 0.5;
  c.surface.triangles = 2000;
  c.surface.remeshed = true;
  c.surface.angles = {{31, {7, 8, 9}}, {12, {1, 2.5, -3}}};
  c.rows = rows;
  study.cases.push_back(c);
  return study;
}

MesherQuality quality_with(double dihedral) {
  return study_of<MesherQuality>(
      {row("ccdt fcc", 1.15, 2.5, dihedral), row("tetgen", 1.5, 8, 10), row("gmsh-hxt", 1.4, 4, 17)});
}

TEST(MesherQualityReport, SaysInWhatWeAreBetterThanAllOthers) {
  for (const std::string& text : {to_terminal(quality_with(16)), to_markdown(quality_with(16))}) {
    EXPECT_TRUE(contains(text, "yes: 1.150, gmsh-hxt 1.400")) << text;
    EXPECT_TRUE(contains(text, "yes: 2.500, gmsh-hxt 4.000")) << text;
    EXPECT_TRUE(contains(text, "NO: 16.00, gmsh-hxt 17.00")) << text;
    EXPECT_TRUE(contains(text, "mean r in 1 of 1")) << text;
    EXPECT_TRUE(contains(text, "smallest dihedral in 0 of 1 cases")) << text;
    EXPECT_TRUE(contains(text, "part.off, 10,000 tetrahedra")) << text;
  }
}

TEST(MesherQualityReport, NamesTheAngleOfTheSurfaceThatForbidsTheAim) {
  const std::string forbidden = to_markdown(quality_with(11));
  EXPECT_TRUE(
      contains(forbidden, "the surface forbids it: two facets meet at 12.0 degrees at (1.0000, 2.5000, -3.0000)"))
      << forbidden;
  MesherQuality allowed = quality_with(11);
  allowed.cases[0].surface.angles.dihedral.degrees = 90;
  EXPECT_TRUE(contains(to_markdown(allowed), "the surface does not forbid it: its facets meet at 90.0 degrees"));
  EXPECT_TRUE(contains(to_markdown(allowed), "the smallest angle of its triangles is 31.0 degrees at (7.0000"));
  EXPECT_FALSE(contains(to_markdown(quality_with(19)), "forbid it"));
}

TEST(MesherQualityReport, ListsMissedAimsAndNoOthers) {
  MesherQuality quality = quality_with(19);
  EXPECT_FALSE(contains(to_terminal(quality), "Aims that are missed"));
  QualityRow& ours = quality.cases[0].rows[0];
  ours.quality.r.mean = 1.25;
  ours.quality.r.max = 3.5;
  ours.seconds = Estimate{0.1, 0.1, 0.1};
  ours.improve_seconds = 0.06;
  const std::string text = to_terminal(quality);
  for (const char* words : {"mean r 1.250 > 1.20", "worst r 3.500 > 3.00", "0.100 million tetrahedra a second < 0.700",
                            "improvement takes 0.0600 s, the rest 0.0400 s"})
    EXPECT_TRUE(contains(text, words)) << words << text;
}

TEST(MesherQualityReport, ShowsFailuresAndUnequalCountsWithTheirReasons) {
  MesherQuality quality = quality_with(19);
  quality.cases[0].rows[1].status = RunStatus::crashed;
  quality.cases[0].rows[1].reason = "ended by signal SIGSEGV";
  quality.cases[0].rows[2].is_comparable = false;
  quality.cases.emplace_back();
  quality.cases[1].name = "open.off";
  quality.cases[1].reason = "the surface is open";
  for (const std::string& text : {to_terminal(quality), to_markdown(quality)}) {
    EXPECT_TRUE(contains(text, "tetgen: crashed: ended by signal SIGSEGV")) << text;
    EXPECT_TRUE(contains(text, "10,000 !")) << text;
    EXPECT_TRUE(contains(text, "gmsh-hxt: 10,000 tetrahedra are not comparable")) << text;
    EXPECT_TRUE(contains(text, "open.off, 0 tetrahedra: the surface is open")) << text;
    EXPECT_TRUE(contains(text, "nothing to compare with")) << text;
  }
}

TEST(MesherQualityReport, HasHistogramsInMarkdown) {
  const std::string text = to_markdown(quality_with(19));
  EXPECT_TRUE(contains(text, "| r, % of tetrahedra | ccdt fcc | tetgen | gmsh-hxt |")) << text;
  EXPECT_TRUE(contains(text, "| 1.00 to 1.10       |     90.0 |")) << text;
  EXPECT_TRUE(contains(text, "0 to 10.0")) << text;
}

TEST(MesherQualityJson, KeepsRowsVerdictsAndTheSurface) {
  const Json json = Json::parse(to_json(quality_with(16)));
  EXPECT_EQ(json["schema"], "ccdt.quality/1");
  const Json& c = json["cases"][0];
  EXPECT_EQ(c["surface"]["smallest_dihedral_angle"]["degrees"], 12);
  EXPECT_EQ(c["surface"]["smallest_dihedral_angle"]["at"][1], 2.5);
  EXPECT_EQ(c["rows"].size(), 3u);
  EXPECT_EQ(c["rows"][1]["quality"]["r"]["max"], 8);
  EXPECT_EQ(c["rows"][1]["samples"].size(), 5u);
  ASSERT_EQ(c["verdicts"].size(), 4u);
  EXPECT_EQ(c["verdicts"][0]["better_than_all"], true);
  EXPECT_EQ(c["verdicts"][3]["better_than_all"], false);
  EXPECT_EQ(c["verdicts"][3]["best_other_variant"], "gmsh-hxt");
}

Lattices lattices_with(double fcc_mean) {
  std::vector<QualityRow> rows;
  for (const std::string suffix : {"", " improved"}) {
    rows.push_back(row("fcc" + suffix, fcc_mean, 3, 20));
    rows.push_back(row("bcc" + suffix, 1.15, 4, 19));
    rows.push_back(row("sc" + suffix, 1.3, 5, 10));
  }
  return study_of<Lattices>(rows);
}

TEST(LatticesReport, StatesThePapersClaimByEachMeasure) {
  for (const std::string& text : {to_terminal(lattices_with(1.2)), to_markdown(lattices_with(1.2))}) {
    EXPECT_TRUE(contains(text, "That FCC is best is confirmed after improvement by: worst r, smallest dihedral"))
        << text;
    EXPECT_TRUE(contains(text, "That FCC is best is not confirmed before improvement by: mean r")) << text;
  }
  EXPECT_TRUE(contains(to_terminal(lattices_with(1.1)), "is confirmed before improvement by: mean r"));
  const Json json = Json::parse(to_json(lattices_with(1.2)));
  EXPECT_EQ(json["schema"], "ccdt.lattices/1");
  EXPECT_EQ(json["claims"].size(), 10u);
  EXPECT_EQ(json["claims"][0]["fcc_is_best"], false);
  EXPECT_EQ(json["claims"][2]["fcc_is_best"], true);
}

TEST(AblationReport, CountsInHowManyCasesEachIsBest) {
  const auto ablation = study_of<Ablation>({row("none", 1.3, 50, 1), row("swap", 1.2, 9, 5), row("all", 1.2, 3, 18)});
  const std::string text = to_markdown(ablation);
  EXPECT_TRUE(contains(text, "| none                  |      0 |")) << text;
  EXPECT_TRUE(contains(text, "| swap                  |      1 |     1 |       0 |                 0 |")) << text;
  EXPECT_TRUE(contains(text, "| all                   |      1 |     1 |       1 |                 1 |")) << text;
  EXPECT_EQ(Json::parse(to_json(ablation))["schema"], "ccdt.ablation/1");
}

LatticeFit fit_with_best(const LatticeSetting& best) {
  std::vector<QualityRow> rows;
  for (const LatticeSetting& setting : lattice_settings())
    rows.push_back(row(name_of(setting), 1.2, setting == best ? 2 : 5, 15));
  return study_of<LatticeFit>(rows);
}

TEST(LatticeFitReport, NamesTheBestSettingAndWhetherItIsTheDefault) {
  const std::string usual = to_terminal(fit_with_best(default_lattice_setting()));
  EXPECT_TRUE(contains(usual, "The best setting is " + name_of(default_lattice_setting()))) << usual;
  EXPECT_TRUE(contains(usual, "It is the default"));
  LatticeSetting other = lattice_settings().front();
  ASSERT_FALSE(other == default_lattice_setting());
  const std::string text = to_markdown(fit_with_best(other));
  EXPECT_TRUE(contains(text, "The best setting is " + name_of(other))) << text;
  EXPECT_TRUE(contains(text, "The default, " + name_of(default_lattice_setting()) + ", has a mean rank of"));
  EXPECT_EQ(Json::parse(to_json(fit_with_best(other)))["summary"].size(), lattice_settings().size());
}

TEST(LatticeFitReport, SaysWhereThereIsNothingToSumUp) {
  EXPECT_TRUE(contains(to_terminal(LatticeFit()), "no surface on which every setting went well"));
}

}  // namespace
}  // namespace ccdt
