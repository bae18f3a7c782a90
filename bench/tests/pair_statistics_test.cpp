#include "bench/gate/pair_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench/tests/fake_targets.h"

namespace ccdt::gate {
namespace {

TEST(PairStatistics, TheThresholdIsTheLargestOfAllAndSaysWhich) {
  const TimeRules rules = {.relative = 0.01, .absolute_seconds = 0.001};
  const auto threshold = [&](double base, const Precision& precision) { return threshold_of(rules, base, precision); };
  EXPECT_DOUBLE_EQ(threshold(1, {}).value, std::log1p(0.01));
  EXPECT_EQ(threshold(1, {}).reason, ThresholdReason::relative);
  EXPECT_DOUBLE_EQ(threshold(0.02, {}).value, std::log1p(0.05));
  EXPECT_EQ(threshold(0.02, {}).reason, ThresholdReason::absolute);
  EXPECT_DOUBLE_EQ(threshold(1, {.noise_floor = 0.03}).value, 0.03);
  EXPECT_EQ(threshold(1, {.noise_floor = 0.03}).reason, ThresholdReason::noise);
  const Precision clock = {.timed_seconds = 1e-6, .clock_seconds = 1e-7};
  EXPECT_DOUBLE_EQ(threshold(1, clock).value, std::log1p(0.2));
  EXPECT_EQ(threshold(1, clock).reason, ThresholdReason::clock);
  EXPECT_EQ(threshold(1, {.layout_deviation = 0.02}).reason, ThresholdReason::layout);
  EXPECT_DOUBLE_EQ(threshold(1, {}).limit, std::log1p(0.03));
}

TEST(PairStatistics, TheFloorForBuildsGrowsWithTheirSpreadAndTheCases) {
  EXPECT_NEAR(layout_floor(0.01, 1), 2.054 * std::sqrt(2.0) * 0.01, 1e-5);
  EXPECT_NEAR(layout_floor(0.01, 10), 2.878 * std::sqrt(2.0) * 0.01, 1e-5);
  EXPECT_EQ(layout_floor(0, 10), 0);
}

TEST(PairStatistics, AnIntervalOnBothSidesOfTheLimitIsOpen) {
  const Threshold threshold = {0.01, 0.03};
  const auto call = [&](double value, double scatter) {
    std::vector<Pair> pairs;
    for (int i = 0; i < 40; ++i) pairs.push_back({1, std::exp(value + (i % 2 == 0 ? scatter : -scatter))});
    return look_at(pairs, threshold, bootstrap_for(0.95, 1)).call;
  };
  EXPECT_EQ(call(0, 0.01), Call::not_worse);
  EXPECT_EQ(call(0.029, 0.01), Call::worse);
  EXPECT_EQ(call(0.02, 0.1), Call::open);
  EXPECT_EQ(call(0.028, 0.1), Call::open) << "narrow or not, a slowdown beyond the limit is not excluded";
}

TEST(PairStatistics, NothingPassesWithAThresholdOfMoreThanHalf) {
  const auto call = [](double threshold) {
    return look_at(pairs_of(1), {std::log1p(threshold), std::log1p(threshold + 0.02)}, bootstrap_for(0.95, 1)).call;
  };
  EXPECT_EQ(call(0.4), Call::not_worse);
  EXPECT_EQ(call(0.6), Call::open);
  EXPECT_EQ(call(10), Call::open);
}

TEST(PairStatistics, ADisturbedPairDoesNotMoveItsLayout) {
  std::vector<Pair> pairs;
  for (int layout = 0; layout < 6; ++layout) pairs.insert(pairs.end(), 3, {1, std::exp(0.01 * layout), false, layout});
  const bench::Estimate quiet = log_ratio_of(pairs, {});
  pairs[7].head *= 3;
  EXPECT_EQ(log_ratio_of(pairs, {}), quiet);
}

TEST(PairStatistics, WithFewLayoutsThePairsAreTheObservations) {
  std::vector<Pair> pairs;
  for (int i = 0; i < 30; ++i) pairs.push_back({1, std::exp(0.01 * (i % 7)), false, i % 3});
  EXPECT_EQ(log_ratio_of(pairs, {}), bench::trimmed_mean_estimate(log_ratios(pairs), trimmed_share));
}

TEST(PairStatistics, TheLooksOfAScreeningTogetherHaveTheConfidenceOfTheRules) {
  EXPECT_NEAR(screening_confidence({.confidence = 0.95}), 0.9875, 1e-12);
  EXPECT_NEAR(screening_confidence({.confidence = 0.99}), 0.9975, 1e-12);
}

TEST(PairStatistics, TheSmallestSlowdownFoundIsBeyondTheThresholdByTheNoise) {
  const Look look = {{0, -0.01, 0.01}, {0.01, 0.03}};
  const double beyond = 0.01 * (1 + 1.645 / 1.96);
  EXPECT_NEAR(smallest_found(look, 200, 0.95, {}), 0.01 + beyond, 1e-4);
  EXPECT_NEAR(smallest_found(look, 50, 0.95, {}), 0.01 + beyond / 2, 1e-4) << "more pairs would have been measured";
  EXPECT_GE(pairs_for_verdict({{0.02, -0.02, 0.06}, {0.01, 0.03}, Call::open}, 20, {}), 100);
}

TEST(PairStatistics, ConfirmationIsStricterWithMoreSuspects) {
  EXPECT_DOUBLE_EQ(confirmation_confidence({.confidence = 0.95}, 1), 0.95);
  EXPECT_DOUBLE_EQ(confirmation_confidence({.confidence = 0.95}, 10), 0.995);
  const bench::Bootstrap few = bootstrap_for(0.95, 1), many = bootstrap_for(0.9995, 1);
  EXPECT_GT(many.resamples, few.resamples);
}

TEST(PairStatistics, LooksGrowUpToTheMost) {
  const TimeRules rules = {.at_least = 20, .at_most = 200};
  int pairs = 0, looks = 0;
  while (pairs < 200) {
    const int next = next_look(pairs, rules);
    ASSERT_GT(next, pairs);
    pairs = next;
    ++looks;
  }
  EXPECT_EQ(pairs, 200);
  EXPECT_LE(looks, 8);
  EXPECT_EQ(next_look(0, {.at_least = 1, .at_most = 2}), 1);
  EXPECT_EQ(next_look(1, {.at_least = 1, .at_most = 2}), 2);
}

}  // namespace
}  // namespace ccdt::gate
