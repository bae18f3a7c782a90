#include "bench/gate/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "baselines/external_program.h"
#include "bench/gate/judge_times.h"
#include "bench/gate/measure_times.h"
#include "bench/tests/fake_targets.h"

namespace ccdt::gate {
namespace {

/// Pairs of an unchanged program whose log ratios have this deviation.
PairedSamples noise(const std::string& name, double deviation, std::size_t pairs, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, deviation);
  PairedSamples samples;
  samples.case_name = name;
  samples.figure = "seconds.mesh";
  for (std::size_t i = 0; i < pairs; ++i) samples.screening.push_back({0.1, 0.1 * std::exp(normal(random))});
  return samples;
}

TEST(Calibration, KnowsTheNoiseOfEachCase) {
  Rules rules;
  rules.time.layout_deviation = 0.005;
  const Calibration c = calibrate({1, {noise("quiet", 0.01, 100, 1), noise("loud", 0.04, 200, 2)}}, rules);
  const CaseNoise& quiet = *find_noise(c, "quiet");
  const CaseNoise& loud = *find_noise(c, "loud");
  EXPECT_EQ(find_noise(c, "other"), nullptr);
  EXPECT_NEAR(quiet.deviation, 0.01, 0.002);
  EXPECT_NEAR(quiet.robust_deviation, 0.01, 0.003);
  EXPECT_NEAR(loud.deviation, 0.04, 0.008);
  EXPECT_NEAR(quiet.seconds, 0.1, 1e-9);
  EXPECT_EQ(quiet.pairs_needed, 20);
  EXPECT_NEAR(loud.pairs_needed, 70, 40);  // (1.96 * 0.04 / 0.01)^2, somewhat more for the trimmed mean
  for (const CaseNoise* one : {&quiet, &loud}) EXPECT_LT(one->noise_floor, 0.01) << "more pairs make up for noise";
  ASSERT_TRUE(quiet.smallest_found && loud.smallest_found);
  EXPECT_LT(*quiet.smallest_found, *loud.smallest_found);
  EXPECT_GT(*quiet.smallest_found, 0.01);
  EXPECT_LT(*loud.smallest_found, 0.06);
  EXPECT_LT(c.rates.false_alarms.value, 0.01);
  EXPECT_GT(c.rates.false_alarms.high, c.rates.false_alarms.value);
  EXPECT_NE(to_text(c).find("loud"), std::string::npos);
}

TEST(Calibration, TheSmallestSlowdownFoundIsFoundByRealGatesAboutAsOften) {
  const Calibration c = calibrate({1, {noise("a", 0.03, 150, 5)}}, {});
  ASSERT_TRUE(c.cases.front().smallest_found);
  const double factor = 1 + *c.cases.front().smallest_found;
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0, 0.03 / std::sqrt(2));
  TimedTarget fake = {"a", "seconds.mesh"};
  fake.run = [&](const RunRequest& request) {
    return measured({{"a", 0.1 * (request.side == Side::head ? factor : 1) * std::exp(normal(random))}});
  };
  fake.command = [](Side, const std::string&) { return ""; };
  int found = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SampleSet samples = start_samples(seed);
    samples.head_program = "another build";
    measure_times(std::vector{fake}, {}, {.calibration = &c}, samples);
    found += judgment_of(judge_times(samples, {}, &c)) == Judgment::worse;
  }
  EXPECT_GE(found, 175);
  EXPECT_LT(found, 200);
}

TEST(Calibration, TooFewPairsSayHowManyAreNeeded) {
  try {
    calibrate({1, {noise("quiet", 0.01, 60, 1), noise("loud", 0.04, 30, 2)}}, {});
    FAIL() << "30 pairs are not enough";
  } catch (const TooFewSamples& e) {
    EXPECT_GT(e.needed(), 40);
    EXPECT_LE(e.needed(), 200);
    EXPECT_NO_THROW(calibrate({1, {noise("loud", 0.04, static_cast<std::size_t>(e.needed()), 2)}}, {}));
  }
}

TEST(Calibration, PairsMustBeAsManyAsAGateWouldTake) {
  Rules rules;
  rules.time.at_least = 4;
  rules.time.at_most = 20;
  EXPECT_THROW(calibrate({1, {noise("loud", 0.08, 10, 2)}}, rules), TooFewSamples);
  EXPECT_NO_THROW(calibrate({1, {noise("quiet", 0.001, 10, 2)}}, rules));
}

TEST(Calibration, DriftRaisesTheNoiseFloor) {
  // Pairs resemble their neighbors, so an interval from a few of them is too narrow.
  PairedSamples samples = noise("a", 0, 0, 1);
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  double drift = 0;
  for (int i = 0; i < 200; ++i) {
    drift = 0.95 * drift + 0.01 * normal(random);
    samples.screening.push_back({0.1, 0.1 * std::exp(drift)});
  }
  Rules rules;
  rules.time.at_least = 8;
  rules.time.at_most = 8;
  EXPECT_GT(calibrate({1, {samples}}, rules).cases.front().noise_floor, 0.001);
}

TEST(Calibration, NoiseThatNoGateOvercomesIsToldInAdvance) {
  Rules rules;
  rules.time.at_most = 60;
  const Calibration c = calibrate({1, {noise("a", 0.8, 60, 3)}}, rules);
  EXPECT_GT(c.cases.front().pairs_needed, 60);
  EXPECT_GT(c.cases.front().smallest_found.value_or(1), 0.4);
  EXPECT_GT(c.rates.undecided.value, 0.5);
  EXPECT_LT(c.rates.false_alarms.value, 0.05);
}

TEST(Calibration, TakesAsManyPairsAsAskedAndConfirmsNothing) {
  TimedTarget fake = {"a", "seconds.mesh"};
  fake.run = [&](const RunRequest& request) { return measured({{"a", request.side == Side::head ? 1.5 : 1}}); };
  fake.command = [](Side, const std::string&) { return "again"; };
  SampleSet samples = start_samples(1);
  measure_times(std::vector{fake}, rules_of_calibration({}, 45), {}, samples);
  EXPECT_EQ(samples.cases.front().screening.size(), 45U);
  EXPECT_TRUE(samples.cases.front().confirmation.empty());
}

TEST(Calibration, TellsTheSpreadOfBuildsFromTheNoiseOfRuns) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  PairedSamples samples = noise("a", 0, 0, 1);
  for (int layout = 1; layout <= 40; ++layout) {
    const double base = 0.02 * normal(random), head = 0.02 * normal(random);
    for (int i = 0; i < 5; ++i)
      samples.screening.push_back(
          {std::exp(base + 0.01 * normal(random)), std::exp(head + 0.01 * normal(random)), false, layout});
  }
  const Calibration c = calibrate({1, {samples}}, {});
  ASSERT_TRUE(c.cases.front().layout_deviation);
  EXPECT_NEAR(*c.cases.front().layout_deviation, 0.02, 0.005);
  EXPECT_NEAR(c.cases.front().deviation, 0.01 * std::sqrt(2.0), 0.003);
  EXPECT_FALSE(calibrate({1, {noise("a", 0.01, 100, 1)}}, {}).cases.front().layout_deviation);
}

TEST(Calibration, TheSpreadOfBuildsIsThatOfOneProgramAndNotOfARatio) {
  // Builds of the base are 2% faster or slower than the mean, and so are those of the head: all four combinations.
  PairedSamples samples = noise("a", 0, 0, 1);
  for (int layout = 0; layout < 80; ++layout) {
    const double base = layout % 2 == 0 ? 0.02 : -0.02, head = layout / 2 % 2 == 0 ? 0.02 : -0.02;
    for (const double noise : {0.001, -0.001})
      samples.screening.push_back({std::exp(base), std::exp(head + noise), false, layout});
  }
  Rules rules;
  rules.time.at_least = rules.time.at_most = 4;
  EXPECT_NEAR(calibrate({1, {samples}}, rules).cases.front().layout_deviation.value_or(0), 0.02, 0.001);
}

TEST(Calibration, IsTheSameAfterAFile) {
  const baselines::TemporaryFolder folder;
  Calibration c = calibrate({7, {noise("a", 0.02, 80, 1)}}, {});
  c.program = "ccdt";
  c.identity = {{"machine.cpu", "this one"}};
  write_calibration(c, folder.path() / "calibration.json");
  const Calibration read = read_calibration(folder.path() / "calibration.json");
  EXPECT_EQ(read.program, "ccdt");
  EXPECT_EQ(read.identity, c.identity);
  EXPECT_EQ(read.seed, 7U);
  EXPECT_EQ(read.rates.false_alarms, c.rates.false_alarms);
  EXPECT_EQ(read.cases.front().noise_floor, c.cases.front().noise_floor);
  EXPECT_EQ(read.cases.front().smallest_found, c.cases.front().smallest_found);
  EXPECT_EQ(read.cases.front().log_ratios, c.cases.front().log_ratios);
}

}  // namespace
}  // namespace ccdt::gate
