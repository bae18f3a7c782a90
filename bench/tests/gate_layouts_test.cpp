#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "bench/tests/fake_targets.h"

namespace ccdt::gate {
namespace {

/// A program whose builds differ in speed; each build keeps its speed. Those of the head are slower by the factor.
TimedTarget rebuilt(const std::string& name, double factor, double deviation, std::uint64_t seed) {
  TimedTarget fake = {name, "real_time"};
  fake.command = [](Side, const std::string&) { return ""; };
  fake.run = [=, noise = std::make_shared<FakeProgram>(seed)](const RunRequest& request) {
    std::mt19937_64 of_build(seed * 1000003 + static_cast<std::uint64_t>(request.layout) * 2 +
                             (request.side == Side::head));
    of_build.discard(10);
    const double speed = std::exp(deviation * std::normal_distribution<double>()(of_build));
    return measured({{name, noise->seconds() * speed * (request.side == Side::head ? factor : 1)}});
  };
  return fake;
}

Judgment gate_of_builds(double factor, double deviation, std::uint64_t seed, bool is_rebuilt) {
  std::vector<TimedTarget> targets;
  for (int i = 0; i < 10; ++i)
    targets.push_back(rebuilt("case " + std::to_string(i), i == 0 ? factor : 1, deviation, seed * 10 + i));
  SampleSet samples = start_samples(seed);
  samples.head_program = "another build";
  samples.is_rebuilt = is_rebuilt;
  measure_times(targets, {}, {}, samples);
  return judgment_of(judge_times(samples, {}, nullptr));
}

TEST(LayoutTest, BuildsThatDifferAreNoSlowdownWhetherRebuiltOrNot) {
  constexpr int gates = 100;
  int alarms_of_one = 0, alarms_of_many = 0;
  for (std::uint64_t seed = 0; seed < gates; ++seed) {
    alarms_of_one += gate_of_builds(1, builds_of_loops, seed, false) == Judgment::worse;
    alarms_of_many += gate_of_builds(1, 0.01, seed, true) == Judgment::worse;
  }
  EXPECT_LE(bench::share_of(alarms_of_one, gates).low, 0.02);
  EXPECT_LE(bench::share_of(alarms_of_many, gates).low, 0.02);
}

TEST(LayoutTest, SeveralBuildsFindFivePercent) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) found += gate_of_builds(1.05, 0.01, seed, true) == Judgment::worse;
  EXPECT_GE(found, 45);
}

TEST(LayoutTest, EachLayoutIsOneObservationAndTheConfirmationHasNewOnes) {
  SampleSet samples = start_samples(1);
  samples.is_rebuilt = true;
  Rules rules;
  rules.time.layouts = 8;
  measure_times(std::vector{rebuilt("a", 1.2, 0.01, 1)}, rules, {}, samples);
  const PairedSamples& one = samples.cases.front();
  std::map<int, int> screened, confirmed;
  for (const Pair& pair : one.screening) ++screened[pair.layout];
  for (const Pair& pair : one.confirmation) ++confirmed[pair.layout];
  EXPECT_GE(screened.size(), 8U);
  EXPECT_GE(confirmed.size(), 8U);
  for (const auto& [layout, pairs] : screened) {
    EXPECT_EQ(pairs, 3);
    EXPECT_FALSE(confirmed.contains(layout));
  }
  // With two layouts of the same difference, more pairs of them say nothing new.
  std::vector<Pair> few, many;
  for (int layout = 0; layout < 6; ++layout)
    for (int i = 0; i < 40; ++i) {
      const Pair pair = {1, std::exp(0.01 * layout), false, layout};
      if (i < 2) few.push_back(pair);
      many.push_back(pair);
    }
  EXPECT_EQ(log_ratio_of(few, {}), log_ratio_of(many, {}));
}

}  // namespace
}  // namespace ccdt::gate
