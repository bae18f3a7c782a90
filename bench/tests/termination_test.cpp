#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/experiments/existence_experiments.h"
#include "bench/run/surface_measures.h"
#include "engine/base/errors.h"
#include "engine/plc/build_plc.h"
#include "models/stars.h"

namespace ccdt {
namespace {

plc::InputPlc star(std::string_view name, double degrees, std::uint64_t variant) {
  return models::make_star(*std::ranges::find(models::stars(), name, &models::Star::name), degrees, variant);
}

MeshResult protect(const InputPlc& input, Protection protection) {
  MeshOptions options;
  options.protection = protection;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
  options.improve.steiner = SteinerRule::keep;
  return mesh_plc(input, options);
}

TEST(Stars, HaveTheAngleThatIsAskedFor) {
  for (const std::string_view name : {"two segments", "three segments", "bundle", "wheel"})
    for (const double degrees : {60.0, 20.0, 5.0})
      for (const std::uint64_t variant : {0u, 3u})
        EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star(name, degrees, variant), {})), degrees, 1e-6)
            << name;
  // The directions of an urchin are evenly distributed, so its angle is only close to the one wanted. For fins, the
  // wanted angle is the dihedral angle.
  EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star("urchin", 20, 0), {})), 20, 4);
  EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star("fins", 10, 0), {})), 10 * std::sqrt(3) / 2, 0.1);
}

TEST(Stars, AreTheSameEachTimeAndDifferByVariant) {
  for (const models::Star& s : models::stars()) {
    EXPECT_EQ(models::make_star(s, 30, 1).vertices, models::make_star(s, 30, 1).vertices);
    EXPECT_NE(models::make_star(s, 30, 1).vertices, models::make_star(s, 30, 2).vertices);
  }
}

TEST(MidpointSplitting, DoesNotEndInAWheelOfTenSpokesOfTwoLengths) {
  const InputPlc wheel = star("wheel", 36, 0);
  EXPECT_THROW(protect(wheel, Protection::midpoint), LimitError);
  EXPECT_EQ(protect(wheel, Protection::shell).counts.steiner_vertices, 5u);  // one on each longer spoke
}

TEST(MidpointSplitting, EndsInAWheelOfEightSpokes) {
  EXPECT_EQ(protect(star("wheel", 45, 0), Protection::midpoint).counts.steiner_vertices, 0u);
}

TEST(MidpointSplitting, DoesNotEndInAnUrchin) {
  const InputPlc urchin = star("urchin", 30, 0);
  EXPECT_THROW(protect(urchin, Protection::midpoint), LimitError);
  EXPECT_GT(protect(urchin, Protection::shell).counts.steiner_vertices, 0u);
}

TEST(MidpointSplitting, EndsForAFewSegmentsOrFinsEvenAtOneDegree) {
  for (const std::string_view name : {"two segments", "three segments", "bundle", "fins"})
    for (const std::uint64_t variant : {0u, 1u, 2u})
      EXPECT_NO_THROW(protect(star(name, 1, variant), Protection::midpoint)) << name;
}

TEST(ShellSplitting, EndsForAllStars) {
  for (const models::Star& s : models::stars())
    for (const double degrees : {36.0, 10.0})
      for (const std::uint64_t variant : {0u, 1u})
        EXPECT_NO_THROW(protect(models::make_star(s, degrees, variant), Protection::shell)) << s.name << " " << degrees;
}

experiments::TerminationRow row(const char* group, double degrees, Protection protection) {
  experiments::TerminationRow made{{}, group, group, degrees, degrees, protection};
  made.measured.asked.name = group;
  bench::add_run(made.measured, {});
  return made;
}

/// A row whose run has failed.
experiments::TerminationRow failed(const char* group, double degrees, baselines::FailureKind kind) {
  experiments::TerminationRow made = row(group, degrees, Protection::midpoint);
  made.measured.first.set_failure(kind, "the surface is open");
  return made;
}

TEST(Termination, ResultSaysAtWhichAnglesMidpointsEnded) {
  using enum baselines::FailureKind;
  experiments::TerminationRow ended = row("wheel", 60, Protection::midpoint);
  ended.measured.first.counts.steiner_vertices = 7;
  ended.measured.first.counts.splits_by_level = {4, 3};
  const results::ExperimentResult result = experiments::termination_result(
      std::vector{ended, failed("wheel", 30, limit), failed("wheel", 20, limit), row("wheel", 30, Protection::shell),
                  failed("file", 0, invalid_input)});
  for (const char* data : {"wheel", "1 of 3", "60", "30", "20"})
    EXPECT_NE(result.findings.at(0).find(data), std::string::npos) << result.findings.at(0);
  EXPECT_NE(result.findings.back().find("1 of 1"), std::string::npos) << result.findings.back();
  const results::ResultTable& table = *results::find_table(result, "stars");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(results::number_in(table, table.rows[0], "midpoint_ended"), 1);
  EXPECT_EQ(results::number_in(table, table.rows[0], "midpoint_steiner_vertices"), 7);
  EXPECT_EQ(results::number_in(table, table.rows[0], "midpoint_deepest_level"), 2);
  EXPECT_EQ(results::number_in(table, table.rows[1], "midpoint_ended"), 0);
  EXPECT_TRUE(std::isnan(results::number_in(table, table.rows[1], "midpoint_steiner_vertices")));
  EXPECT_EQ(results::number_in(table, table.rows[1], "shell_ended"), 1);
  const results::ResultTable& files = *results::find_table(result, "solids");
  EXPECT_EQ(results::text_in(files, files.rows.at(0), "reason"), "the surface is open");
  EXPECT_EQ(result.problems.size(), 1u);
  EXPECT_TRUE(result.is_good);  // the user's file is not our fault
}

TEST(Termination, TellsTheLimitFromOtherFailures) {
  using enum baselines::FailureKind;
  const auto ended = [](const experiments::TerminationRow& only) {
    const results::ExperimentResult result = experiments::termination_result(std::vector{only});
    const results::ResultTable& runs = *results::find_table(result, "star_runs");
    return results::text_in(runs, runs.rows.at(0), "ended") + (result.is_good ? "" : ", bad");
  };
  EXPECT_EQ(ended(row("wheel", 30, Protection::midpoint)), "yes");
  EXPECT_EQ(ended(failed("wheel", 30, limit)), "no");
  EXPECT_EQ(ended(failed("wheel", 30, timeout)), ", bad");
  EXPECT_EQ(ended(failed("wheel", 30, invalid_input)), ", bad");
}

TEST(Termination, LeavesOutStarsThatWereNotMeasured) {
  const auto result = experiments::termination_result(std::vector{row("solid", 0, Protection::midpoint)});
  EXPECT_TRUE(results::find_table(result, "stars")->rows.empty());
  EXPECT_EQ(result.findings, (std::vector<std::string>{"Midpoint on solids and files ended in 1 of 1 cases"}));
}

}  // namespace
}  // namespace ccdt
