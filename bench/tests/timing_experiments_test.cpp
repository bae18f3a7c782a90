#include "bench/experiments/timing_experiments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "bench/experiments/speed.h"

namespace ccdt {
namespace {

/// Does one of the lines contain this number?
bool say(const std::vector<std::string>& lines, const std::string& data) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(data) != std::string::npos; });
}

const results::ResultTable& table(const results::ExperimentResult& result, std::string_view name) {
  const results::ResultTable* found = results::find_table(result, name);
  if (found == nullptr) throw std::out_of_range("no table " + std::string(name));
  return *found;
}

/// The numbers of a column.
std::vector<double> numbers(const results::ExperimentResult& result, std::string_view name, std::string_view column) {
  std::vector<double> all;
  for (const results::ResultRow& row : table(result, name).rows)
    all.push_back(results::number_in(table(result, name), row, column));
  return all;
}

std::vector<std::string> texts(const results::ExperimentResult& result, std::string_view name,
                               std::string_view column) {
  std::vector<std::string> all;
  for (const results::ResultRow& row : table(result, name).rows)
    all.push_back(results::text_in(table(result, name), row, column));
  return all;
}

/// A case of a mesher with a warm-up that took a minute, and counted runs that took these seconds.
bench::MeasuredCase measured_case(const std::string& mesher, const std::vector<StageCosts>& seconds,
                                  const MeshCounts& counts) {
  bench::MeasuredCase measured;
  measured.id = "0123456789abcdef";
  measured.asked.name = "the case of " + mesher;
  measured.asked.mesher = mesher;
  measured.asked.repetitions.warm_up = 1;
  bench::RunRecord record;
  record.mesher.name = mesher;
  record.counts = counts;
  record.mesh_fingerprint = "abc";
  record.costs.mesh_seconds = record.costs[Stage::delaunay].seconds = record.costs[Stage::front].seconds = 60;
  add_run(measured, record);
  for (const StageCosts& s : seconds) {
    record.costs = s;
    add_run(measured, record);
  }
  return measured;
}

StageCosts stages(double delaunay, double front, double mesh = 0) {
  StageCosts costs;
  costs[Stage::delaunay].seconds = delaunay;
  costs[Stage::front].seconds = front;
  costs.mesh_seconds = mesh;
  return costs;
}

MeshCounts counts_with(std::uint64_t vertices) {
  MeshCounts counts;
  counts.vertices = counts.front_tetrahedra = vertices;
  return counts;
}

void fail(bench::MeasuredCase& measured) {
  bench::RunRecord record = measured.first;
  record.set_failure(baselines::FailureKind::timeout, "limit of 600 s");
  add_run(measured, record);
}

/// The Delaunay stage takes n^exponent microseconds and examines as many vertices, ten times as many if `work`. The
/// front takes 2 n microseconds, which is twice as long as Delaunay if that is linear, and makes 5 n tetrahedra.
std::vector<experiments::Fig8Row> series(const std::string& strategy, double exponent,
                                         const std::string& mesher = "ccdt", double decades = 2) {
  std::vector<experiments::Fig8Row> rows;
  constexpr int count = 9;
  for (int i = 0; i < count; ++i) {
    const double size = std::round(1000 * std::pow(10, decades * i / (count - 1)));
    const StageCosts s = stages(1e-6 * std::pow(size, exponent), 2e-6 * size, 1e-6 * std::pow(size, exponent));
    MeshCounts counts = counts_with(static_cast<std::uint64_t>(size));
    counts.front_tetrahedra = 5 * counts.vertices;
    experiments::Fig8Row& row = rows.emplace_back();
    row.measured = measured_case(mesher, {s, s, s, s, s}, counts);
    row.measured.first.costs[Stage::delaunay].work.vertices_examined =
        static_cast<std::uint64_t>(10 * std::pow(size, exponent));
    row.measured.first.costs[Stage::front].work.front_candidates = 20 * counts.front_tetrahedra;
    row.seconds = mesher == "ccdt" ? experiments::cdt_seconds : experiments::whole_seconds;
    row.model = "piston", row.strategy = strategy;
    row.edge_length = 1e5 / size;
  }
  return rows;
}

TEST(Fig8, FitsEachStageOnItsOwn) {
  const auto result = experiments::fig8_result(series("paper, without check", 1.5));
  EXPECT_EQ(texts(result, "fits", "quantity"), (std::vector<std::string>{"cdt", "delaunay", "front"}));
  const std::vector<double> exponents = numbers(result, "fits", "exponent");
  EXPECT_GT(exponents[0], 1.4);
  EXPECT_LT(exponents[0], 1.5);
  EXPECT_NEAR(exponents[1], 1.5, 1e-9);
  EXPECT_NEAR(exponents[2], 1, 1e-9);
  EXPECT_NEAR(numbers(result, "fits", "per_unit")[2], 0.4, 1e-6) << "microseconds for a tetrahedron of the front";
  EXPECT_EQ(numbers(result, "fits", "sizes"), (std::vector<double>{9, 9, 9}));
  EXPECT_EQ(numbers(result, "lines", "vertices"), (std::vector<double>{1000, 100000}));
  EXPECT_EQ(table(result, "fits").rows[0].runs.size(), 5u) << "all cases here have one id";
}

TEST(Fig8, FitsExactWorkOnItsOwn) {
  const auto result = experiments::fig8_result(series("paper, without check", 1.5, "ccdt", 3));
  EXPECT_EQ(texts(result, "work", "quantity"),
            (std::vector<std::string>{"Delaunay: vertices examined", "front: candidates"}));
  EXPECT_NEAR(numbers(result, "work", "exponent")[0], 1.5, 1e-3);
  EXPECT_NEAR(numbers(result, "work", "exponent")[1], 1, 1e-9);
  EXPECT_NEAR(numbers(result, "work", "per_unit")[1], 20, 1e-6);
  EXPECT_EQ(texts(result, "work", "judged"), (std::vector<std::string>{"yes", "yes"}));
}

TEST(Fig8, JudgesWorkOverThreeDecadesAndTimesOverTwo) {
  const auto judged = [](double decades) {
    const auto result = experiments::fig8_result(series("paper, with check", 1, "ccdt", decades));
    return std::pair(texts(result, "work", "judged")[0], texts(result, "fits", "judged")[0]);
  };
  EXPECT_EQ(judged(1.9), std::pair(std::string("no"), std::string("no")));
  EXPECT_EQ(judged(2.9), std::pair(std::string("no"), std::string("yes")));
  EXPECT_EQ(judged(3), std::pair(std::string("yes"), std::string("yes")));
}

TEST(Fig8, FitsTheWholeOfOtherMeshersAndOfRefinement) {
  EXPECT_EQ(texts(experiments::fig8_result(series("TetGen", 1, "tetgen")), "fits", "quantity"),
            std::vector<std::string>{"mesh"});
  EXPECT_EQ(texts(experiments::fig8_result(series("Delaunay refinement, ours", 1)), "fits", "quantity"),
            std::vector<std::string>{"mesh"});
}

TEST(Fig8, FitsEachStrategyOfEachModelAlone) {
  std::vector<experiments::Fig8Row> rows = series("TetGen", 1, "tetgen");
  experiments::append(rows, series("Mesh_3", 1.2, "cgal-mesh3"));
  experiments::append(rows, series("Mesh_3", 1.4, "cgal-mesh3"));
  for (std::size_t i = 18; i < 27; ++i) rows[i].model = "bracket";
  const auto result = experiments::fig8_result(rows);
  EXPECT_EQ(texts(result, "fits", "model"), (std::vector<std::string>{"piston", "piston", "bracket"}));
  EXPECT_NEAR(numbers(result, "fits", "exponent")[1], 1.2, 1e-9);
  EXPECT_NEAR(numbers(result, "fits", "exponent")[2], 1.4, 1e-9);
  EXPECT_EQ(table(result, "points").rows.size(), 27u);
}

TEST(Fig8, LeavesOutFailedPointsAndDoesNotFitTwo) {
  std::vector<experiments::Fig8Row> rows = series("paper, with check", 1);
  fail(rows[3].measured);
  auto result = experiments::fig8_result(rows);
  EXPECT_NEAR(numbers(result, "fits", "exponent")[0], 1, 1e-9);
  EXPECT_EQ(numbers(result, "fits", "sizes")[0], 8);
  EXPECT_EQ(texts(result, "points", "status")[3], "timeout");
  EXPECT_TRUE(std::isnan(numbers(result, "points", "vertices")[3]));
  for (std::size_t i = 2; i < rows.size(); ++i) fail(rows[i].measured);
  EXPECT_TRUE(table(experiments::fig8_result(rows), "fits").rows.empty());
}

/// What a finding says after its last colon, without a remark in parentheses.
std::string outcome_of(const std::string& finding) {
  const std::string text = finding.substr(0, finding.rfind(" ("));
  return text.substr(text.rfind(": "));
}

TEST(Fig8, SaysWhetherTheExponentIsAsClaimedWhereItIsJudged) {
  const auto findings = [](double exponent, double decades) {
    return experiments::fig8_result(series("TetGen", exponent, "tetgen", decades)).findings;
  };
  EXPECT_NE(outcome_of(findings(1, 2)[0]), outcome_of(findings(1.6, 2)[0]));
  EXPECT_NE(findings(1, 1)[0], findings(1, 2)[0]);
  EXPECT_FALSE(say(findings(1, 1), "piston")) << "a fit that is not judged has no finding of its own";
}

TEST(Fig8, IsNotGoodWhereARunOfOursFailed) {
  for (const std::string mesher : {"ccdt", "tetgen"}) {
    std::vector<experiments::Fig8Row> rows = series("paper, with check", 1, mesher);
    EXPECT_TRUE(experiments::fig8_result(rows).is_good);
    fail(rows[1].measured);
    EXPECT_EQ(experiments::fig8_result(rows).is_good, mesher != "ccdt");
    EXPECT_TRUE(say(experiments::fig8_result(rows).problems, "600 s"));
  }
}

/// Three values are too few for an interval.
std::vector<double> twice(std::vector<double> values) {
  values.insert(values.end(), values.begin(), values.end());
  return values;
}

/// The octree takes these seconds, twice each; grid and cavity take 1.
std::vector<experiments::LocatorsRow> locators(experiments::SurfaceKind kind, const std::vector<double>& octree) {
  std::vector<experiments::LocatorsRow> rows;
  for (const LocatorKind locator : {LocatorKind::grid, LocatorKind::octree, LocatorKind::cavity}) {
    std::vector<StageCosts> seconds;
    for (const double s : twice(octree)) seconds.push_back(stages(1, locator == LocatorKind::octree ? s : 1));
    rows.push_back({{measured_case("ccdt", seconds, counts_with(1000)), results::stage_seconds(Stage::front)},
                    "part",
                    kind,
                    false,
                    181,
                    locator});
  }
  return rows;
}

TEST(Locators, ExpectTheOctreeAheadOnlyWhereEdgesDiffer) {
  using Kind = experiments::SurfaceKind;
  const auto findings = [](Kind kind, const std::vector<double>& octree) {
    return experiments::locators_result(locators(kind, octree)).findings;
  };
  const std::vector<double> fast = {0.5, 0.5, 0.5}, slow = {1.5, 1.5, 1.5}, either = {0.5, 0.9, 1, 1.1, 1.5};
  const auto outcome = [&](Kind kind, const std::vector<double>& octree) {
    return outcome_of(findings(kind, octree)[0]);
  };
  EXPECT_TRUE(say(findings(Kind::graded, fast), "181"));
  EXPECT_TRUE(say(findings(Kind::graded, fast), "0.5"));
  EXPECT_EQ(outcome(Kind::graded, fast), outcome(Kind::uniform, slow));
  EXPECT_NE(outcome(Kind::graded, slow), outcome(Kind::graded, fast));
  EXPECT_NE(outcome(Kind::uniform, either), outcome(Kind::uniform, slow));
  EXPECT_NE(outcome(Kind::uniform, either), outcome(Kind::graded, slow));
  EXPECT_TRUE(findings(Kind::input, slow).empty());
  EXPECT_TRUE(findings(Kind::rough, slow).empty());
}

/// A run with this many seconds and tetrahedra.
experiments::SpeedRow speed_row(const std::string& mesher, unsigned threads, double seconds,
                                std::uint64_t tetrahedra = 1000, bool is_weak = false) {
  MeshCounts counts;
  counts.tetrahedra = tetrahedra;
  const std::vector<StageCosts> six(6, stages(seconds / 2, 0, seconds));
  return {{measured_case(mesher, six, counts)}, "end to end", "part", threads, is_weak};
}

TEST(Speed, ComparesAllWithCcdtOnOneThreadAndFindsWhatIsSerial) {
  std::vector<experiments::SpeedRow> rows = {speed_row("ccdt", 1, 3), speed_row("ccdt", 2, 2),
                                             speed_row("tetgen", 1, 6, 500), speed_row("ccdt", 2, 3, 1500, true)};
  const auto result = experiments::speed_result(rows);
  EXPECT_TRUE(result.is_good);
  EXPECT_EQ(texts(result, "speed", "mesher"), (std::vector<std::string>{"ccdt", "ccdt", "tetgen"}));
  EXPECT_EQ(numbers(result, "speed", "ratio"), (std::vector<double>{1, 2.0 / 3, 2}));
  EXPECT_NEAR(numbers(result, "speed", "microseconds_per_tetrahedron")[2], 12000, 1e-6);
  EXPECT_EQ(numbers(result, "stages", "delaunay"), (std::vector<double>{1.5, 1}));
  // Two threads are 1.5 times as fast if a third of the work is serial: 3 = 1 + 2, and 2 = 1 + 1.
  EXPECT_EQ(texts(result, "scaling", "scaling"), (std::vector<std::string>{"strong", "weak"}));
  EXPECT_EQ(numbers(result, "scaling", "speedup"), (std::vector<double>{1.5, 1.5}));
  EXPECT_NEAR(numbers(result, "scaling", "serial_share")[0], 1.0 / 3, 1e-12);
  EXPECT_NEAR(numbers(result, "scaling", "projection")[0], 1 / (1.0 / 3 + 2.0 / 3 / 64), 1e-12);
  fail(rows[1].measured);
  EXPECT_FALSE(experiments::speed_result(rows).is_good);
}

TEST(Locators, CompareEachWithTheGrid) {
  const auto result = experiments::locators_result(locators(experiments::SurfaceKind::uniform, {3, 3, 3}));
  EXPECT_EQ(texts(result, "ratios", "ratio"), (std::vector<std::string>{"octree / grid", "cavity / grid"}));
  EXPECT_EQ(numbers(result, "ratios", "value"), (std::vector<double>{3, 1}));
  EXPECT_EQ(table(result, "sizes").rows.size(), 1u);
}

TEST(Locators, GiveAFailedRowItsReason) {
  std::vector<experiments::LocatorsRow> rows = locators(experiments::SurfaceKind::graded, {1, 1, 1});
  fail(rows[1].measured);
  const auto result = experiments::locators_result(rows);
  EXPECT_TRUE(say(result.problems, "600 s"));
  EXPECT_FALSE(result.is_good);
  EXPECT_EQ(texts(result, "ratios", "ratio"), std::vector<std::string>{"cavity / grid"});
  EXPECT_TRUE(result.findings.empty());
}

/// The check takes this share of Delaunay's time in the runs, which has a median of 2 s; the front takes this many
/// seconds. There are two runs of each.
experiments::Table1Model table1_model(const std::vector<double>& check = {0.1, 0.1, 0.1}, double front = 14,
                                      const std::vector<double>& delaunay = {2, 2, 2}) {
  experiments::Table1Model model{"piston", 2.5};
  const std::vector<double> checks = twice(check), delaunays = twice(delaunay);
  std::vector<StageCosts> with, without;
  for (std::size_t i = 0; i < checks.size(); ++i) {
    with.push_back(stages(delaunays[i], checks[i] * delaunays[i], 9));
    without.push_back(stages(2, front, 20));
  }
  model.cases["with_check"] = measured_case("ccdt", with, counts_with(1000));
  model.cases["without_check"] = measured_case("ccdt", without, counts_with(1000));
  model.cases["without_check"].first.costs[Stage::front].work.visibility_tests = 30000;
  return model;
}

TEST(Table1, SaysWhichWorkThePapersFactorWouldNeed) {
  const auto findings = [](const experiments::Table1Model& model) {
    return experiments::table1_result({&model, 1}).findings;
  };
  // Per vertex 2000 us of Delaunay, 200 of the check and, for its one tetrahedron, 14,000 of the front. The factor of
  // 602.25 / 26.01 needs 48,940.
  const auto different = findings(table1_model());
  ASSERT_EQ(different.size(), 3u);
  EXPECT_TRUE(say({different[0]}, "1.019"));
  EXPECT_TRUE(say({different[1]}, "23.15"));
  EXPECT_TRUE(say({different[2]}, "3.50 ")) << different[2];
  EXPECT_TRUE(say({different[2]}, "14000 ")) << different[2];
  EXPECT_TRUE(say({different[2]}, "30.0 ")) << "visibility tests per tetrahedron: " << different[2];
  const auto alike = findings(table1_model({0.01, 0.01, 0.01}, 48)),
             undecided = findings(table1_model({0.005, 0.02, 0.03}));
  const auto verdict = [](const std::string& finding) { return finding.substr(finding.rfind(':')); };
  EXPECT_NE(verdict(alike[0]), verdict(different[0]));
  EXPECT_NE(verdict(alike[0]), verdict(undecided[0]));
  EXPECT_NE(verdict(different[0]), verdict(undecided[0]));
  EXPECT_NE(verdict(alike[1]), verdict(different[1]));
}

TEST(Table1, CallsALookUpALookUpAndJudgesThePapersAlgorithm) {
  experiments::Table1Model model = table1_model();
  model.cases["default_with_check"] = model.cases["with_check"];
  model.cases["looked_up"] = model.cases["without_check"];
  const auto result = experiments::table1_result({&model, 1});
  const std::vector<std::string> ratios = texts(result, "ratios", "ratio");
  EXPECT_EQ(std::ranges::count(ratios, "without / with check"), 1);
  EXPECT_EQ(std::ranges::count(ratios, "default: looked up / with check"), 1);
  for (const results::ResultRow& row : table(result, "ratios").rows) {
    const bool is_default =
        results::text_in(table(result, "ratios"), row, "ratio").find("default") != std::string::npos;
    EXPECT_EQ(std::isnan(results::number_in(table(result, "ratios"), row, "paper_value")), is_default);
  }
  EXPECT_EQ(texts(result, "work", "way"),
            (std::vector<std::string>{"with_check", "without_check", "default_with_check", "looked_up"}));
  EXPECT_EQ(numbers(result, "work", "visibility_tests")[1], 30);
}

TEST(Table1, DividesWithinARunWhereBothAreOfIt) {
  const experiments::Table1Model model = table1_model({0.1, 0.1, 0.1}, 14, {1, 2, 3});
  const auto result = experiments::table1_result({&model, 1});
  EXPECT_EQ(texts(result, "ratios", "ratio"),
            (std::vector<std::string>{"with check / Delaunay", "without check / Delaunay", "without / with check"}));
  const results::ResultTable& ratios = table(result, "ratios");
  const auto check = std::get<bench::Estimate>(results::cell(ratios, ratios.rows[0], "value"));
  EXPECT_DOUBLE_EQ(check.low, 1.1);
  EXPECT_DOUBLE_EQ(check.high, 1.1);
  // Without the check 16 s, in rounds with 1, 2 and 3 s.
  EXPECT_DOUBLE_EQ(numbers(result, "ratios", "value")[1], 8);
  EXPECT_NEAR(numbers(result, "ratios", "paper_value")[0], 26.01 / 25.53, 1e-12);
}

TEST(Table1, DecidesNothingWithFewerThanSixRuns) {
  experiments::Table1Model model = table1_model();
  for (auto& [way, measured] : model.cases) measured.counted.pop_back();
  const auto result = experiments::table1_result({&model, 1});
  const results::ResultTable& ratios = table(result, "ratios");
  for (const results::ResultRow& row : ratios.rows)
    EXPECT_FALSE(std::get<bench::Estimate>(results::cell(ratios, row, "value")).has_interval());
  EXPECT_EQ(numbers(result, "ratios", "value")[1], 8) << "the value is shown";
  const auto decided = experiments::table1_result(std::array{table1_model()}).findings;
  EXPECT_NE(result.findings.front().substr(result.findings.front().rfind(':')),
            decided.front().substr(decided.front().rfind(':')));
}

TEST(Table1, HasARowForAllThatIsTimedOfARun) {
  const experiments::Table1Model model = table1_model();
  const auto result = experiments::table1_result({&model, 1});
  EXPECT_EQ(texts(result, "times", "what"),
            (std::vector<std::string>{"Delaunay", "CDT with face protection check", "CDT without"}));
  EXPECT_EQ(numbers(result, "times", "seconds"), (std::vector<double>{2, 2.2, 16}));
  EXPECT_EQ(numbers(result, "times", "paper_seconds")[2], 602.25);
  EXPECT_EQ(texts(result, "sizes", "same_tetrahedra"), std::vector<std::string>{"yes"});
  EXPECT_EQ(numbers(result, "costs", "delaunay"), std::vector<double>{2000});
  EXPECT_EQ(numbers(result, "costs", "front"), std::vector<double>{14000});
  EXPECT_TRUE(say(result.findings, "7.27 [7.27, 7.27]"));
  EXPECT_TRUE(result.is_good);
}

TEST(Table1, IsNotGoodIfTheTetrahedraDiffer) {
  experiments::Table1Model model = table1_model();
  model.cases["without_check"].first.mesh_fingerprint = "abd";
  const auto result = experiments::table1_result({&model, 1});
  EXPECT_EQ(texts(result, "sizes", "same_tetrahedra"), std::vector<std::string>{"no"});
  EXPECT_FALSE(result.is_good);
}

TEST(Table1, ShowsFailuresAsRows) {
  experiments::Table1Model model = table1_model();
  fail(model.cases["without_check"]);
  const auto result = experiments::table1_result({&model, 1});
  EXPECT_EQ(texts(result, "times", "status")[2], "timeout");
  EXPECT_EQ(texts(result, "ratios", "ratio"), std::vector<std::string>{"with check / Delaunay"});
  EXPECT_TRUE(table(result, "costs").rows.empty());
  EXPECT_EQ(result.problems.size(), 1u);
  EXPECT_FALSE(result.is_good);
}

TEST(TimedCases, AreThoseOfWhichAllRunsAreWithinTheBudget) {
  experiments::ExperimentOptions options;
  options.tetrahedra = 20000;
  const double budget = experiments::timed_case(options, "", {}).repetitions.budget_seconds;
  const auto is_short = [&](double seconds, bool fails = false) {
    bench::MeasuredCase measured;
    bench::RunRecord record;
    record.costs.mesh_seconds = seconds;
    add_run(measured, record);
    if (fails) fail(measured);
    return experiments::is_short(options, measured);
  };
  EXPECT_TRUE(is_short(0.99 * budget / options.runs));
  EXPECT_FALSE(is_short(1.01 * budget / options.runs));
  EXPECT_FALSE(is_short(0, true));
}

TEST(TimedCases, AreRepeatedUntilTheyAreKnown) {
  experiments::ExperimentOptions options;
  options.tetrahedra = 20000;
  const bench::Case single = experiments::single_case(options, "name", "ccdt", "part.off", {});
  EXPECT_TRUE(single.verify);
  EXPECT_EQ(single.repetitions.at_most, 1);
  const bench::Case timed = experiments::timed_case(options, "group", single, 0.02, experiments::cdt_seconds);
  EXPECT_EQ(timed.repetitions.warm_up, 1);
  EXPECT_EQ(timed.repetitions.at_least, options.runs);
  EXPECT_GE(timed.repetitions.at_most, 60);
  EXPECT_EQ(timed.repetitions.until, 0.02);
  EXPECT_GE(options.runs, bench::fewest_for_interval);
  EXPECT_EQ(timed.group, "group");
}

}  // namespace
}  // namespace ccdt
