#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "baselines/external_program.h"
#include "bench/sweep/estimate.h"
#include "bench/sweep/input_size.h"
#include "bench/sweep/status.h"

namespace ccdt {
namespace {

using bench::MeasuredCase;

bench::RunRecord good_run(double seconds = 0, std::uint64_t bytes = 0) {
  bench::RunRecord record;
  record.costs.mesh_seconds = seconds;
  record.peak_rss_bytes = bytes;
  return record;
}

bench::RunRecord failed_run(baselines::FailureKind kind) {
  bench::RunRecord record;
  record.set_failure(kind, "why");
  return record;
}

MeasuredCase measured(const std::string& id, const std::vector<bench::RunRecord>& runs, int repetitions = 1) {
  MeasuredCase one;
  one.id = id;
  one.asked.repetitions.at_least = one.asked.repetitions.at_most = repetitions;
  for (const bench::RunRecord& run : runs) add_run(one, run);
  return one;
}

TEST(SweepStatus, CountsEachCaseOnceAndAllRecords) {
  const baselines::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "runs");
  for (const char* name : {"a-0", "a-1", "b-0", "c-0", "c-1", "other-0"})
    std::ofstream(folder.path() / "runs" / (std::string(name) + ".json")) << "{}";
  std::ofstream(folder.path() / "runs" / "a-1.json.tmp") << "{}";
  const std::vector<MeasuredCase> all = {measured("a", {good_run(), good_run()}, 2), measured("b", {good_run()}, 2),
                                         measured("c", {good_run(), failed_run(baselines::FailureKind::timeout)}, 3),
                                         measured("d", {}),
                                         measured("e", {failed_run(baselines::FailureKind::crashed)})};
  const sweep::SweepStatus status = sweep::status_of(all, folder.path());
  EXPECT_EQ(status.cases, 5u);
  EXPECT_EQ(status.runs, 6u);
  EXPECT_EQ(status.finished, 1u);
  EXPECT_EQ(status.failed, 2u);
  EXPECT_EQ(status.missing, 2u);
  EXPECT_EQ(status.obsolete, 1u);
  EXPECT_EQ(status.failures, (std::map<std::string, std::size_t>{{"crashed", 1}, {"timeout", 1}}));
}

TEST(SweepStatus, OfAFolderThatIsNotThereHasNoRuns) {
  const sweep::SweepStatus status = sweep::status_of(std::vector{measured("a", {})}, "/nowhere");
  EXPECT_EQ(status.runs, 0u);
  EXPECT_EQ(status.missing, 1u);
}

class SweepEstimates : public testing::Test {
 protected:
  /// A cube, and the cost of its run if it is finished.
  void add(const std::string& mesher, double edge_length, const std::vector<bench::RunRecord>& runs = {}) {
    sweep::SweepCase one;
    one.asked.mesher = one.mesher = mesher;
    one.input = {"cube", "/nowhere/cube.poly", "cube", edge_length};
    cases_.push_back(one);
    measured_.push_back(measured(std::to_string(cases_.size()), runs));
  }

  double tetrahedra(double edge_length) const {
    return estimated_tetrahedra(sweep::size_of({"cube", "", "cube", edge_length}), {});
  }

  std::vector<sweep::CaseEstimate> estimates() const { return sweep::estimate_cases(cases_, measured_); }

  std::vector<sweep::SweepCase> cases_;
  std::vector<MeasuredCase> measured_;
};

TEST_F(SweepEstimates, OfTetrahedraGoWithTheVolume) {
  EXPECT_NEAR(tetrahedra(0.05), 6 * std::sqrt(2) * 8000, 0.02 * 6 * std::sqrt(2) * 8000);
  EXPECT_NEAR(tetrahedra(0.01) / tetrahedra(0.02), 8, 0.1);
}

TEST_F(SweepEstimates, FollowThePowerLawOfTheSameMesher) {
  const auto seconds = [&](double edge_length) { return 1e-6 * std::pow(tetrahedra(edge_length), 1.2); };
  const auto bytes = [&](double edge_length) {
    return static_cast<std::uint64_t>(15e6 + 300 * tetrahedra(edge_length));
  };
  for (const double edge_length : {0.1, 0.05, 0.03})
    add("ccdt", edge_length, {good_run(seconds(edge_length), bytes(edge_length))});
  add("ccdt", 0.5, {good_run(seconds(0.5), 5'000'000)});  // too small to say anything about memory
  add("ccdt", 0.01);
  const sweep::CaseEstimate estimate = estimates().back();
  EXPECT_EQ(estimate.neighbors, 4);
  EXPECT_EQ(estimate.runs, 1);
  EXPECT_NEAR(estimate.seconds, seconds(0.01), 0.1 * seconds(0.01));
  EXPECT_NEAR(estimate.memory_bytes, static_cast<double>(bytes(0.01)), 0.1 * static_cast<double>(bytes(0.01)));
  EXPECT_EQ(estimates().front().runs, 0);
}

TEST_F(SweepEstimates, AreNoLongerThanTheLimit) {
  add("ccdt", 0.05, {good_run(1000)});
  add("ccdt", 0.01);
  cases_.back().asked.limits.seconds = 60;
  EXPECT_EQ(estimates().back().seconds, 60);
}

TEST_F(SweepEstimates, SayWhichMeshersNobodyKnows) {
  add("ccdt", 0.1, {good_run(2)});
  add("ccdt", 0.05);
  add("ccdt", 0.05, {failed_run(baselines::FailureKind::refused)});
  add("tetgen", 0.1);
  measured_.back().asked.repetitions = {.warm_up = 1, .at_least = 5, .at_most = 20, .until = 0.1};
  const sweep::SweepEstimate sum = sweep::sum_of(cases_, measured_, estimates());
  EXPECT_EQ(sum.cases, 4u);
  EXPECT_EQ(sum.finished_cases, 1u);
  EXPECT_EQ(sum.missing_cases, 2u);
  EXPECT_EQ(sum.missing_runs, 1u + 7u);
  EXPECT_EQ(sum.unknown_meshers, std::vector<std::string>{"tetgen"});
  EXPECT_GT(sum.most_seconds, sum.seconds);
}

}  // namespace
}  // namespace ccdt
