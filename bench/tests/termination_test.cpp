#include <gtest/gtest.h>

#include <cmath>

#include "bench/experiments/existence_experiments.h"
#include "bench/surface_measures.h"
#include "engine/base/errors.h"
#include "engine/plc/build_plc.h"

namespace ccdt {
namespace {

const experiments::Star& star(std::string_view name) {
  for (const experiments::Star& s : experiments::stars())
    if (s.name == name) return s;
  throw std::out_of_range("no such star");
}

MeshResult protect(const InputPlc& input, Protection protection) {
  MeshOptions options;
  options.protection = protection;
  options.lattice = Lattice::none;
  options.improve.improvement = Improvement::none;
  return mesh_plc(input, options);
}

TEST(Stars, HaveTheAngleThatIsAskedFor) {
  for (const std::string_view name : {"two segments", "three segments", "bundle", "wheel"})
    for (const double degrees : {60.0, 20.0, 5.0})
      for (const std::uint64_t variant : {0u, 3u})
        EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star(name).make(degrees, variant), {})), degrees, 1e-6)
            << name;
  // About as wanted, to the nearest of an even distribution; and fins at this dihedral angle.
  EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star("urchin").make(20, 0), {})), 20, 4);
  EXPECT_NEAR(bench::smallest_segment_angle(plc::build_plc(star("fins").make(10, 0), {})), 10 * std::sqrt(3) / 2, 0.1);
}

TEST(Stars, AreTheSameEachTimeAndDifferByVariant) {
  for (const experiments::Star& s : experiments::stars()) {
    EXPECT_EQ(s.make(30, 1).vertices, s.make(30, 1).vertices);
    EXPECT_NE(s.make(30, 1).vertices, s.make(30, 2).vertices);
  }
}

TEST(MidpointSplitting, DoesNotEndInAWheelOfTenSpokesOfTwoLengths) {
  const InputPlc wheel = star("wheel").make(36, 0);
  EXPECT_THROW(protect(wheel, Protection::midpoint), LimitError);
  EXPECT_EQ(protect(wheel, Protection::shell).counts.steiner_vertices, 5u);  // one on each longer spoke
}

TEST(MidpointSplitting, EndsInAWheelOfEightSpokes) {
  EXPECT_EQ(protect(star("wheel").make(45, 0), Protection::midpoint).counts.steiner_vertices, 0u);
}

TEST(MidpointSplitting, DoesNotEndInAnUrchin) {
  const InputPlc urchin = star("urchin").make(30, 0);
  EXPECT_THROW(protect(urchin, Protection::midpoint), LimitError);
  EXPECT_GT(protect(urchin, Protection::shell).counts.steiner_vertices, 0u);
}

TEST(MidpointSplitting, EndsForAFewSegmentsOrFinsEvenAtOneDegree) {
  for (const std::string_view name : {"two segments", "three segments", "bundle", "fins"})
    for (const std::uint64_t variant : {0u, 1u, 2u})
      EXPECT_NO_THROW(protect(star(name).make(1, variant), Protection::midpoint)) << name;
}

TEST(ShellSplitting, EndsForAllStars) {
  for (const experiments::Star& s : experiments::stars())
    for (const double degrees : {36.0, 10.0})
      for (const std::uint64_t variant : {0u, 1u})
        EXPECT_NO_THROW(protect(s.make(degrees, variant), Protection::shell)) << s.name << " " << degrees;
}

experiments::TerminationCase stopped(const char* group, double degrees) {
  return {{.status = baselines::RunStatus::failed,
           .reason = "a segment cannot be protected: it would have to be split into more than 2^20 pieces",
           .runs = {"runs/stopped.json"}},
          group,
          "0",
          degrees,
          degrees};
}

TEST(Termination, TellsTheLimitFromOtherFailures) {
  experiments::TerminationCase c = stopped("wheel", 30);
  EXPECT_EQ(experiments::termination_of(c), experiments::Termination::stopped);
  c.reason = "the facets enclose nothing";
  EXPECT_EQ(experiments::termination_of(c), experiments::Termination::unknown);
  c = stopped("wheel", 30);
  c.status = baselines::RunStatus::timeout;
  EXPECT_EQ(experiments::termination_of(c), experiments::Termination::unknown);
  c.status = baselines::RunStatus::ok;
  EXPECT_EQ(experiments::termination_of(c), experiments::Termination::ended);
}

TEST(Termination, ResultSaysAtWhichAnglesMidpointsEnded) {
  experiments::TerminationCase ended = stopped("wheel", 60);
  ended.status = baselines::RunStatus::ok;
  ended.reason.clear();
  ended.counts.steiner_vertices = 7;
  ended.counts.splits_by_level = {4, 3};
  experiments::TerminationCase shell = stopped("wheel", 30);
  shell.status = baselines::RunStatus::ok;
  shell.protection = Protection::shell;
  experiments::TerminationCase bad = stopped("file", 0);
  bad.input = "open.off";
  bad.reason = "the surface is open";
  const results::ExperimentResult result =
      experiments::termination_result(std::vector{ended, stopped("wheel", 30), stopped("wheel", 20), shell, bad});
  EXPECT_EQ(
      result.findings.at(0),
      "Midpoint, wheel: ended in 1 of 3 cases; from 60 degrees up it always ended; it did not at 30 to 20 degrees");
  EXPECT_EQ(result.findings.back(), "Shell on stars ended in 1 of 1 cases");
  const results::ResultTable& table = *results::find_table(result, "stars");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(results::number_in(table, table.rows[0], "midpoint_ended"), 1);
  EXPECT_EQ(results::number_in(table, table.rows[0], "midpoint_steiner_vertices"), 7);
  EXPECT_EQ(results::number_in(table, table.rows[1], "midpoint_ended"), 0);
  EXPECT_TRUE(std::isnan(results::number_in(table, table.rows[1], "midpoint_steiner_vertices")));
  EXPECT_EQ(results::number_in(table, table.rows[1], "shell_ended"), 1);
  const results::ResultTable& files = *results::find_table(result, "solids");
  EXPECT_EQ(results::text_in(files, files.rows.at(0), "reason"), "the surface is open");
  EXPECT_EQ(result.problems.size(), 1u);
  EXPECT_TRUE(result.is_good);  // the user's file is not our fault
}

}  // namespace
}  // namespace ccdt
