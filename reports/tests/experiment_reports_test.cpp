#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/fig8_report.h"
#include "reports/interior_points_report.h"
#include "reports/locators_report.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Fig8 fig8_with_exponent(double exponent) {
  Fig8Series series{"insert", "with check", {}, {}};
  for (const std::uint64_t n : {10000, 20000, 40000}) {
    Fig8Point point;
    point.edge_length = 3e4 / static_cast<double>(n);
    point.counts.vertices = n;
    point.counts.tetrahedra = 5 * n;
    StageSeconds seconds;
    seconds.delaunay = 1e-5 * std::pow(static_cast<double>(n), exponent);
    point.samples.assign(5, seconds);
    point.cdt = Estimate{seconds.delaunay, seconds.delaunay, seconds.delaunay};
    series.points.push_back(point);
  }
  series.fits = fit_series(series, false);
  Fig8 fig8;
  fig8.how.runs = 5;
  fig8.models.push_back({"piston", {series}});
  return fig8;
}

TEST(Fig8Report, SaysWhetherTheExponentIsAsClaimed) {
  for (const auto& [exponent, words] :
       {std::pair{1.0, "is at most 1.10: holds"}, {1.3, "is at most 1.10: does not hold"}}) {
    const Fig8 fig8 = fig8_with_exponent(exponent);
    EXPECT_TRUE(contains(to_terminal(fig8), words)) << to_terminal(fig8);
    EXPECT_TRUE(contains(to_markdown(fig8), words)) << to_markdown(fig8);
  }
}

TEST(Fig8Report, ShowsSizesAndPointsThatFailedOrHaveFewerRuns) {
  Fig8 fig8 = fig8_with_exponent(1);
  EXPECT_FALSE(contains(to_terminal(fig8), "Fewer runs"));
  EXPECT_FALSE(contains(to_terminal(fig8), "What went wrong"));
  auto& points = fig8.models[0].series[0].points;
  points[2].samples.resize(3);
  points[1].cdt = {};
  points[1].status = RunStatus::timeout;
  points[1].reason = "limit of 600 s";
  for (const std::string& text : {to_terminal(fig8), to_markdown(fig8)}) {
    EXPECT_TRUE(contains(text, "40,000")) << text;
    EXPECT_TRUE(contains(text, "200,000")) << text;
    EXPECT_TRUE(contains(text, "3 counted runs")) << text;
    EXPECT_TRUE(contains(text, "timeout: limit of 600 s")) << text;
  }
}

TEST(Fig8Report, SaysWhereThereIsTooLittleToFit) {
  Fig8 fig8 = fig8_with_exponent(1);
  fig8.models[0].series[0].fits.clear();
  EXPECT_TRUE(contains(to_terminal(fig8), "too few sizes"));
}

TEST(Fig8Json, AndCsvKeepEveryRun) {
  const Fig8 fig8 = fig8_with_exponent(1);
  const Json json = Json::parse(to_json(fig8));
  EXPECT_EQ(json["schema"], "ccdt.fig8/1");
  EXPECT_EQ(json["claimed_exponent"], 1.1);
  const Json& series = json["models"][0]["series"][0];
  EXPECT_EQ(series["points"].size(), 3u);
  EXPECT_EQ(series["points"][0]["samples"].size(), 5u);
  EXPECT_NEAR(series["fits"][0]["exponent"]["value"].get<double>(), 1, 1e-9);
  EXPECT_EQ(series["fits"][0]["claim"], "holds");
  const std::string csv = to_csv(fig8);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 16);
  EXPECT_TRUE(contains(csv, "\npiston,insert,3,1,10000,50000,0.1")) << csv;
}

LocatorsCase locators_case(SurfaceKind kind, const Estimate& ratio) {
  LocatorsCase c;
  c.name = "part";
  c.kind = kind;
  c.edge_ratio = 181;
  for (const LocatorKind locator : {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity})
    c.rows.push_back({locator, {2, 2, 2, 2, 2}, Estimate{2, 2, 2}, RunStatus::ok, ""});
  c.octree_over_grid = ratio;
  return c;
}

std::string terminal_of(const LocatorsCase& c) {
  Locators locators;
  locators.cases.push_back(c);
  return to_terminal(locators);
}

TEST(LocatorsReport, JudgesByTheRatioThatWasMeasured) {
  EXPECT_TRUE(
      contains(terminal_of(locators_case(SurfaceKind::graded, {0.5, 0.4, 0.6})),
               "octree is faster than the grid where edges differ by a factor of 181: holds (octree / grid 0.5"));
  EXPECT_TRUE(contains(terminal_of(locators_case(SurfaceKind::graded, {1.5, 1.4, 1.6})), "181: does not hold"));
  EXPECT_TRUE(contains(terminal_of(locators_case(SurfaceKind::uniform, {1.5, 1.4, 1.6})),
                       "grid is faster than the octree where edges are even: holds"));
  EXPECT_TRUE(contains(terminal_of(locators_case(SurfaceKind::uniform, {1, 0.9, 1.1})), "even: undecided"));
  EXPECT_FALSE(contains(terminal_of(locators_case(SurfaceKind::input, {1, 0.9, 1.1})), "is faster"));
}

TEST(LocatorsReport, GivesAFailedRowItsReason) {
  LocatorsCase c = locators_case(SurfaceKind::rough, {1, 1, 1});
  c.rows[2] = {LocatorKind::cavity, {}, {}, RunStatus::crashed, "ended by signal SIGSEGV"};
  EXPECT_TRUE(contains(terminal_of(c), "part, check off, cavity: crashed: ended by signal SIGSEGV"));
}

TEST(LocatorsJson, KeepsSamplesRatiosAndTheClaim) {
  Locators locators;
  locators.cases.push_back(locators_case(SurfaceKind::graded, {0.5, 0.4, 0.6}));
  const Json json = Json::parse(to_json(locators));
  EXPECT_EQ(json["schema"], "ccdt.locators/1");
  const Json& c = json["cases"][0];
  EXPECT_EQ(c["rows"][1]["locator"], "octree");
  EXPECT_EQ(c["rows"][1]["samples"].size(), 5u);
  EXPECT_EQ(c["octree/grid"]["median"], 0.5);
  EXPECT_TRUE(c["cavity/grid"].is_null());
  EXPECT_EQ(c["claim"], "holds");
  EXPECT_EQ(c["edge_ratio"], 181);
}

InteriorPoints points_with_drops(std::uint64_t dropped) {
  InteriorPoints points;
  points.cases = {{"cube", 0.5, Lattice::fcc, InteriorRule::paper, 1000, 0, RunStatus::ok, ""},
                  {"cube", 0.5, Lattice::fcc, InteriorRule::no_spheres, 1200, dropped, RunStatus::ok, ""},
                  {"part.off", 0, Lattice::sc, InteriorRule::paper, 0, 0, RunStatus::failed, "it is open"}};
  return points;
}

TEST(InteriorPointsReport, CountsTheHarmAndListsItsCases) {
  for (const std::string& text : {to_terminal(points_with_drops(3)), to_markdown(points_with_drops(3))}) {
    EXPECT_TRUE(contains(text, "Rule \"paper\": no point did harm in 1 cases with 1,000 interior vertices")) << text;
    EXPECT_TRUE(contains(text, "Rule \"no spheres\": points do harm: 3 points of 1,203")) << text;
    EXPECT_TRUE(contains(text, "Rule \"no distances\": no case to judge by")) << text;
    EXPECT_TRUE(contains(text, "cube at 0.500")) << text;
    EXPECT_TRUE(contains(text, "part.off, sc, paper: failed: it is open")) << text;
  }
  EXPECT_FALSE(contains(to_terminal(points_with_drops(0)), "points do harm"));
  EXPECT_FALSE(contains(to_terminal(points_with_drops(0)), "cube at 0.500"));
}

TEST(InteriorPointsJson, KeepsEveryCaseAndTheSums) {
  const Json json = Json::parse(to_json(points_with_drops(3)));
  EXPECT_EQ(json["schema"], "ccdt.interior-points/1");
  EXPECT_EQ(json["cases"].size(), 3u);
  EXPECT_EQ(json["cases"][1]["rule"], "no spheres");
  EXPECT_EQ(json["cases"][1]["dropped"], 3);
  EXPECT_EQ(json["cases"][2]["reason"], "it is open");
  EXPECT_EQ(json["summary"][0]["failed"], 1);
  EXPECT_EQ(json["summary"][1]["harmed"], 1);
}

}  // namespace
}  // namespace ccdt
