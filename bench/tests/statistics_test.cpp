#include "bench/run/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ccdt {
namespace {

TEST(Statistics, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(bench::median(std::vector{3.0, 1.0, 2.0}), 2);
  EXPECT_EQ(bench::median(std::vector{4.0, 1.0, 3.0, 2.0}), 2.5);
  EXPECT_EQ(bench::median(std::vector{7.0}), 7);
}

TEST(Statistics, QuantilesInterpolateAsTypeSevenOfHyndmanAndFan) {
  // R: quantile(c(1, 2, 4, 8, 16), c(0, .1, .25, .9, 1)) is 1.0 1.4 2.0 12.8 16.0
  const std::vector<double> samples = {16, 1, 8, 2, 4};
  EXPECT_DOUBLE_EQ(bench::quantile(samples, 0), 1);
  EXPECT_DOUBLE_EQ(bench::quantile(samples, 0.1), 1.4);
  EXPECT_DOUBLE_EQ(bench::quantile(samples, 0.25), 2);
  EXPECT_DOUBLE_EQ(bench::quantile(samples, 0.9), 12.8);
  EXPECT_DOUBLE_EQ(bench::quantile(samples, 1), 16);
}

TEST(Statistics, SameSamplesAlwaysGiveTheSameInterval) {
  const std::vector<double> samples = {3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_EQ(bench::trimmed_mean_estimate(samples, 0.2), bench::trimmed_mean_estimate(samples, 0.2));
}

TEST(Statistics, AnotherSeedDrawsOtherSamples) {
  const std::vector<double> samples = {3, 1, 4, 1, 5, 9, 2, 6};
  EXPECT_NE(bench::trimmed_mean_estimate(samples, 0, {.resamples = 10, .seed = 1}),
            bench::trimmed_mean_estimate(samples, 0, {.resamples = 10, .seed = 2}));
}

TEST(Statistics, OneResampleGivesAnIntervalOfNoWidth) {
  const bench::Estimate estimate = bench::trimmed_mean_estimate(std::vector{3.0, 1.0, 4.0}, 0, {.resamples = 1});
  EXPECT_EQ(estimate.low, estimate.high);
}

TEST(Statistics, EverySampleIsDrawn) {
  // All three draws are the one that differs with a probability of 1/27, more than 2.5%.
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> samples(3, 1.0);
    samples[i] = 9;
    EXPECT_EQ(bench::trimmed_mean_estimate(samples, 0).high, 9) << i;
  }
}

TEST(Statistics, TheSpreadIsThatOfTheWiderSide) {
  EXPECT_DOUBLE_EQ(bench::relative_spread({10, 9, 12}), 0.2);
  EXPECT_DOUBLE_EQ(bench::relative_spread({10, 7, 11}), 0.3);
  EXPECT_EQ(bench::relative_spread({0, -1, 1}), 0);
  EXPECT_GT(bench::relative_spread(bench::without_interval(1)), 1e300);
}

/// Student's t with two degrees of freedom: no variance.
double heavy_tailed(std::mt19937_64& random) {
  return std::student_t_distribution<double>(2)(random);
}

TEST(Statistics, TrimmedMeanDropsItsShareAtEachEnd) {
  // scipy.stats.trim_mean([1, 2, 3, 4, 5, 6, 7, 8, 9, 100], 0.2) is 5.5
  EXPECT_DOUBLE_EQ(bench::trimmed_mean(std::vector<double>{100, 2, 3, 4, 5, 6, 7, 8, 9, 1}, 0.2), 5.5);
  EXPECT_DOUBLE_EQ(bench::trimmed_mean(std::vector<double>{1, 2, 6}, 0), 3);
  EXPECT_DOUBLE_EQ(bench::trimmed_mean(std::vector<double>{1, 2, 6, 11}, 0.2), 5);
}

TEST(Statistics, DeviationsOfFewSamples) {
  // R: sd(c(2, 4, 4, 4, 5, 5, 7, 9)), mad(c(2, 4, 4, 4, 5, 5, 7, 9))
  const std::vector<double> samples = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_NEAR(bench::standard_deviation(samples), 2.1380899, 1e-7);
  EXPECT_NEAR(bench::robust_deviation(samples), 0.7413011, 1e-7);
  EXPECT_EQ(bench::standard_deviation(std::vector{3.0}), 0);
  EXPECT_EQ(bench::robust_deviation(std::vector{3.0}), 0);
}

TEST(Statistics, DeviationsOfANormalSampleAreThatOfItsDistribution) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(10, 2);
  std::vector<double> samples(4000);
  for (double& sample : samples) sample = normal(random);
  EXPECT_NEAR(bench::standard_deviation(samples), 2, 0.1);
  EXPECT_NEAR(bench::robust_deviation(samples), 2, 0.1);
  EXPECT_NEAR(bench::autocorrelation(samples), 0, 0.05);
  samples[7] = 1e6;
  EXPECT_GT(bench::standard_deviation(samples), 1000);
  EXPECT_NEAR(bench::robust_deviation(samples), 2, 0.1);
}

TEST(Statistics, AutocorrelationOfAnAutoregressiveSeriesIsItsCoefficient) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  std::vector<double> samples(4000);
  double last = 0;
  for (double& sample : samples) sample = last = 0.6 * last + normal(random);
  EXPECT_NEAR(bench::autocorrelation(samples), 0.6, 0.05);
}

TEST(Statistics, AutocorrelationOfFewSamples) {
  // R: acf(1:4)$acf[2]
  EXPECT_DOUBLE_EQ(bench::autocorrelation(std::vector{1.0, 2.0, 3.0, 4.0}), 0.25);
  EXPECT_EQ(bench::autocorrelation(std::vector{1.0, 2.0}), 0);
  EXPECT_EQ(bench::autocorrelation(std::vector{2.5, 2.5, 2.5, 2.5}), 0);
}

TEST(Statistics, IntervalOfTheTrimmedMeanCoversTheCenterOfHeavyTailsAboutAsOftenAsItSays) {
  std::mt19937_64 random(5);
  for (const std::size_t count : {20, 60})
    for (const double confidence : {0.95, 0.98}) {
      int covered = 0;
      constexpr int trials = 1000;
      for (std::uint64_t trial = 0; trial < trials; ++trial) {
        std::vector<double> samples(count);
        for (double& sample : samples) sample = heavy_tailed(random);
        const auto estimate = bench::trimmed_mean_estimate(samples, 0.2, {confidence, 500, trial});
        covered += estimate.low <= 0 && 0 <= estimate.high;
      }
      EXPECT_GE(covered, trials * (confidence - 0.03)) << count << " samples";
      EXPECT_LE(covered, trials * std::min(1.0, confidence + 0.03)) << count << " samples";
    }
}

TEST(Statistics, OneOutlierHardlyMovesTheIntervalOfTheTrimmedMean) {
  std::vector<double> samples(20);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<double>(i % 5);
  samples[0] = 1e9;
  const bench::Estimate estimate = bench::trimmed_mean_estimate(samples, 0.2);
  EXPECT_GT(estimate.low, 1);
  EXPECT_LT(estimate.high, 3.5);
}

TEST(Statistics, SharesHaveTheIntervalOfClopperAndPearson) {
  // scipy.stats.binomtest(k, 200).proportion_ci(): (0.0012133, 0.0356547) for k = 2, (0, 0.0182753) for k = 0
  const bench::Estimate two = bench::share_of(2, 200), none = bench::share_of(0, 200), all = bench::share_of(200, 200);
  EXPECT_NEAR(two.value, 0.01, 1e-12);
  EXPECT_NEAR(two.low, 0.0012133, 1e-7);
  EXPECT_NEAR(two.high, 0.0356547, 1e-7);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 0.0182753, 1e-7);
  EXPECT_NEAR(all.low, 1 - none.high, 1e-9);
  EXPECT_EQ(all.high, 1);
}

TEST(Regression, FitsAnscombesFirstSetAsRDoes) {
  // Anscombe 1973. R: summary(lm(y1 ~ x1, anscombe)), confint(lm(y1 ~ x1, anscombe))
  const std::vector<double> x = {10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y = {8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const bench::LineFit fit = bench::fit_line(x, y);
  EXPECT_NEAR(fit.slope.value, 0.5000909, 1e-7);
  EXPECT_NEAR(fit.slope.low, 0.2333701, 1e-6);
  EXPECT_NEAR(fit.slope.high, 0.7668117, 1e-6);
  EXPECT_NEAR(fit.intercept, 3.0000909, 1e-7);
  EXPECT_NEAR(fit.r_squared, 0.6665425, 1e-7);
}

TEST(Regression, APointOffALineOfThreeGivesTheIntervalOfOneDegreeOfFreedom) {
  // Residuals 1/6, -1/3, 1/6; half width = t(1, 0.975) * sqrt(1/6 / 2) with t = tan(0.475 pi) = 12.7062
  const bench::LineFit fit = bench::fit_line(std::vector{0.0, 1.0, 2.0}, std::vector{0.0, 0.0, 1.0});
  EXPECT_NEAR(fit.slope.value, 0.5, 1e-15);
  EXPECT_NEAR(fit.slope.high - fit.slope.value, 12.706204736 * std::sqrt(1.0 / 12), 1e-8);
  EXPECT_NEAR(fit.r_squared, 0.75, 1e-12);
}

TEST(Regression, PowerLawsHaveTheirExponentAndAnIntervalOfNoWidth) {
  for (const double exponent : {0.5, 1.0, 1.1, 2.0}) {
    std::vector<double> x, y;
    for (double n = 1e4; n < 2e6; n *= 2) {
      x.push_back(n);
      y.push_back(3e-6 * std::pow(n, exponent));
    }
    const bench::LineFit fit = bench::fit_power(x, y);
    EXPECT_NEAR(fit.slope.value, exponent, 1e-12);
    EXPECT_NEAR(fit.slope.high, fit.slope.low, 1e-9);
    EXPECT_NEAR(std::exp(fit.intercept), 3e-6, 1e-15);
    EXPECT_NEAR(fit.r_squared, 1, 1e-12);
  }
}

TEST(Regression, ALineThroughEqualValuesExplainsThem) {
  const bench::LineFit fit = bench::fit_line(std::vector{1.0, 2.0, 3.0}, std::vector{5.0, 5.0, 5.0});
  EXPECT_EQ(fit.slope, (bench::Estimate{0, 0, 0}));
  EXPECT_EQ(fit.intercept, 5);
  EXPECT_EQ(fit.r_squared, 1);
}

TEST(Regression, MoreConfidenceNeedsAWiderInterval) {
  const std::vector<double> x = {1, 2, 3, 4}, y = {1, 2.2, 2.9, 4.1};
  const bench::LineFit narrow = bench::fit_line(x, y, 0.5), wide = bench::fit_line(x, y, 0.99);
  EXPECT_GT(narrow.slope.low, wide.slope.low);
  EXPECT_LT(narrow.slope.high, wide.slope.high);
  EXPECT_EQ(narrow.slope.value, wide.slope.value);
}

TEST(Bounds, AnIntervalThatEndsAtTheBoundHolds) {
  EXPECT_EQ(bench::is_at_most({2, 1, 3}, 3), bench::BoundTest::holds);
  EXPECT_EQ(bench::is_at_least({2, 1, 3}, 1), bench::BoundTest::holds);
}

TEST(Bounds, ABoundInsideIsUndecided) {
  for (const double bound : {1.0, 1.5, 2.5})
    EXPECT_EQ(bench::is_at_most({2, 1, 3}, bound), bench::BoundTest::undecided);
  for (const double bound : {1.5, 2.5, 3.0})
    EXPECT_EQ(bench::is_at_least({2, 1, 3}, bound), bench::BoundTest::undecided);
}

TEST(Bounds, AnEstimateWithoutAnIntervalDecidesNothing) {
  const bench::Estimate estimate = bench::without_interval(2);
  EXPECT_FALSE(estimate.has_interval());
  EXPECT_TRUE(bench::Estimate({2, 1, 3}).has_interval());
  for (const double bound : {-1e300, 1.0, 2.0, 3.0, 1e300}) {
    EXPECT_EQ(bench::is_at_most(estimate, bound), bench::BoundTest::undecided);
    EXPECT_EQ(bench::is_at_least(estimate, bound), bench::BoundTest::undecided);
  }
}

TEST(Bounds, AnIntervalOnTheWrongSideFails) {
  EXPECT_EQ(bench::is_at_most({2, 1, 3}, 0.9), bench::BoundTest::fails);
  EXPECT_EQ(bench::is_at_least({2, 1, 3}, 3.1), bench::BoundTest::fails);
}

}  // namespace
}  // namespace ccdt
