#include "bench/statistics.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ccdt {
namespace {

TEST(Statistics, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(median(std::vector{3.0, 1.0, 2.0}), 2);
  EXPECT_EQ(median(std::vector{4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_EQ(median(std::vector{7.0}), 7);
}

TEST(Statistics, QuantilesInterpolateAsTypeSevenOfHyndmanAndFan) {
  // R: quantile(c(1, 2, 4, 8, 16), c(0, .1, .25, .9, 1)) is 1.0 1.4 2.0 12.8 16.0
  const std::vector<double> samples = {16, 1, 8, 2, 4};
  EXPECT_DOUBLE_EQ(quantile(samples, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.1), 1.4);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.25), 2);
  EXPECT_DOUBLE_EQ(quantile(samples, 0.9), 12.8);
  EXPECT_DOUBLE_EQ(quantile(samples, 1), 16);
}

TEST(Statistics, EqualSamplesHaveAnIntervalOfNoWidth) {
  const Estimate estimate = median_estimate(std::vector<double>(5, 2.5));
  EXPECT_EQ(estimate.value, 2.5);
  EXPECT_EQ(estimate.low, 2.5);
  EXPECT_EQ(estimate.high, 2.5);
}

TEST(Statistics, IntervalOfTheMedianContainsItAndStaysWithinTheSamples) {
  const std::vector<double> samples = {1.0, 1.1, 1.2, 1.3, 9.0};
  const Estimate estimate = median_estimate(samples);
  EXPECT_EQ(estimate.value, 1.2);
  EXPECT_LE(estimate.low, 1.2);
  EXPECT_GE(estimate.high, 1.2);
  EXPECT_GE(estimate.low, 1.0);
  EXPECT_LE(estimate.high, 9.0);
}

TEST(Statistics, SameSamplesAlwaysGiveTheSameInterval) {
  const std::vector<double> samples = {3, 1, 4, 1, 5, 9, 2, 6};
  const Estimate a = median_estimate(samples), b = median_estimate(samples);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(Statistics, NinetyFivePercentIntervalCoversTheTrueMedianAboutThatOften) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(10, 1);
  int covered = 0;
  constexpr int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> samples(25);
    for (double& sample : samples) sample = normal(random);
    const Estimate estimate = median_estimate(samples, {.resamples = 500});
    covered += estimate.low <= 10 && 10 <= estimate.high;
  }
  EXPECT_GE(covered, trials * 90 / 100);
  EXPECT_LE(covered, trials * 99 / 100);
}

TEST(Statistics, RatioOfMediansOfScaledSamplesIsTheScale) {
  const std::vector<double> samples = {1.0, 1.02, 0.98, 1.01, 0.99};
  std::vector<double> scaled;
  for (const double sample : samples) scaled.push_back(16 * sample);
  const Estimate ratio = ratio_of_medians(scaled, samples);
  EXPECT_DOUBLE_EQ(ratio.value, 16);
  EXPECT_LT(ratio.low, 16);
  EXPECT_GT(ratio.high, 16);
  EXPECT_GT(ratio.low, 16 * 0.95);
  EXPECT_LT(ratio.high, 16 * 1.05);
}

}  // namespace
}  // namespace ccdt
