#include "bench/run/median_interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace ccdt {
namespace {

using bench::Estimate;
using Looks = std::vector<int>;

/// The probability that the interval between the ranks r from below and from above misses the median of a continuous
/// distribution: fewer than r of n samples are on one side of it.
double error_of_rank(int rank, int n) {
  double error = 0;
  for (int k = 0; k < rank; ++k)
    error += 2 * std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1) - n * std::log(2));
  return error;
}

TEST(MedianInterval, RanksAreThoseOfTheSignTest) {
  // Two-sided critical values at 5% plus 1 (Conover 1999, "Practical Nonparametric Statistics", table A3; in R,
  // qbinom(0.025, n, 0.5))
  const std::vector<int> ranks = {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 5, 5, 5, 6, 6, 6, 7, 7, 8};
  for (int n = 6; n <= 25; ++n) EXPECT_EQ(bench::rank_of_interval(n), ranks[static_cast<std::size_t>(n - 6)]) << n;
  EXPECT_EQ(bench::rank_of_interval(100), 40);
  EXPECT_EQ(bench::rank_of_interval(1000), 469);
}

TEST(MedianInterval, ReachesFromARankToTheSameFromAbove) {
  EXPECT_EQ(bench::median_estimate(std::vector{5.0, 2.0, 9.0, 1.0, 4.0, 3.0}), (Estimate{3.5, 1, 9}));
  EXPECT_EQ(bench::median_estimate(std::vector{9.0, 1.0, 8.0, 2.0, 7.0, 3.0, 6.0, 4.0, 5.0}), (Estimate{5, 2, 8}));
  std::vector<double> twenty(20);
  std::iota(twenty.rbegin(), twenty.rend(), 1.0);
  EXPECT_EQ(bench::median_estimate(twenty), (Estimate{10.5, 6, 15}));
}

TEST(MedianInterval, FewerThanSixSamplesHaveNone) {
  for (std::size_t n = 1; n < 6; ++n) {
    const Estimate estimate = bench::median_estimate(std::vector<double>(n, 2.5));
    EXPECT_EQ(estimate.value, 2.5);
    EXPECT_FALSE(estimate.has_interval()) << n;
    EXPECT_EQ(bench::is_at_most(estimate, 1e300), bench::BoundTest::undecided);
    EXPECT_EQ(bench::is_at_least(estimate, -1e300), bench::BoundTest::undecided);
    EXPECT_EQ(bench::relative_spread(estimate), std::numeric_limits<double>::infinity());
  }
  EXPECT_EQ(bench::median_estimate(std::vector<double>(6, 2.5)), (Estimate{2.5, 2.5, 2.5}));
}

TEST(MedianInterval, ErrsInAtMostFivePercentAndANarrowerOneDoesNot) {
  for (int n = 6; n <= 500; ++n) {
    const int rank = bench::rank_of_interval(n);
    EXPECT_LE(error_of_rank(rank, n), 0.05 + 1e-12) << n;
    EXPECT_GT(error_of_rank(rank + 1, n), 0.05) << n;
  }
}

TEST(MedianInterval, OfTensOfThousandsHasTheRankOfTheNormalDistribution) {
  constexpr int n = 90000;
  EXPECT_NEAR(bench::rank_of_interval(n), n / 2.0 - 1.959964 * std::sqrt(n) / 2, 2);
}

TEST(Looks, TripleFromTheFirstWithAnIntervalToTheLast) {
  EXPECT_EQ(bench::looks_between(6, 60), (Looks{6, 18, 60}));
  EXPECT_EQ(bench::looks_between(6, 20), (Looks{6, 20}));
  EXPECT_EQ(bench::looks_between(2, 9), (Looks{6, 9}));
  EXPECT_EQ(bench::looks_between(10, 1000), (Looks{10, 30, 90, 270, 1000}));
  EXPECT_EQ(bench::looks_between(7, 7), (Looks{7}));
  EXPECT_EQ(bench::looks_between(3, 5), (Looks{5}));
}

TEST(Looks, AllIntervalsTogetherErrInAtMostFivePercent) {
  for (int at_least = 1; at_least <= 40; ++at_least)
    for (int at_most = std::max(6, at_least); at_most <= 400; at_most += 7) {
      const Looks looks = bench::looks_between(at_least, at_most);
      double error = 0;
      for (const int look : looks) {
        const int rank = bench::rank_of_interval(look, looks);
        EXPECT_GE(rank, 1) << look << " of " << at_least << " to " << at_most;
        error += error_of_rank(rank, look);
      }
      EXPECT_LE(error, 0.05 + 1e-12) << at_least << " to " << at_most;
    }
}

TEST(Looks, SpendMostOfTheErrorThatTheyMay) {
  // The range of 6 errs in 3.1%. Of 18, the rank 4 errs in 0.75%, and 5 in 3.1%. Of 60, the rank 20 errs in 0.62%; 21
  // would in 1.35%, but only 1.12% are left.
  const Looks looks = bench::looks_between(6, 60);
  EXPECT_EQ(bench::rank_of_interval(6, looks), 1);
  EXPECT_EQ(bench::rank_of_interval(18, looks), 4);
  EXPECT_EQ(bench::rank_of_interval(60, looks), 20);
}

TEST(Looks, AnInterruptionBetweenTwoHasAnIntervalThatAllowsForThePastOnes) {
  const Looks looks = bench::looks_between(6, 60);
  for (int n = 7; n < 60; ++n) {
    const int rank = bench::rank_of_interval(n, looks);
    EXPECT_GE(rank, 1) << n;
    EXPECT_LE(error_of_rank(rank, n), 0.05 - 1.0 / 32 + 1e-12) << n;
  }
}

TEST(MedianRatio, OfRunsInTurnsIsFreeOfChangesThatBothFeel) {
  const std::vector<double> speed = {1, 3, 2, 5, 4, 9};
  std::vector<double> twice;
  for (const double s : speed) twice.push_back(2 * s);
  EXPECT_EQ(bench::median_ratio(twice, speed), (Estimate{2, 2, 2}));
}

TEST(MedianRatio, PairsRunsOfTheSameNumber) {
  const std::vector<double> above = {1, 2, 3, 4, 5, 6, 100}, below = {1, 1, 1, 2, 2, 2};
  EXPECT_EQ(bench::median_ratio(above, below), (Estimate{2.25, 1, 3})) << "1, 2, 3, 2, 2.5, 3";
  EXPECT_FALSE(bench::median_ratio(std::vector{1.0, 2.0}, below).has_interval());
}

}  // namespace
}  // namespace ccdt
