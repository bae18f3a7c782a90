#include "bench/experiments/growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace ccdt::experiments {
namespace {

std::vector<double> sizes_over(double decades, int count) {
  std::vector<double> sizes;
  for (int i = 0; i < count; ++i) sizes.push_back(1000 * std::pow(10, decades * i / (count - 1)));
  return sizes;
}

Growth grown(const std::vector<double>& sizes, const std::function<double(double)>& law, double noise = 0) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  std::vector<double> values;
  for (const double n : sizes) values.push_back(law(n) * std::exp(noise > 0 ? normal(random) : 0));
  return growth_of(sizes, values);
}

const auto linear = [](double n) { return 3 * n; };
const auto n_log_n = [](double n) { return 3 * n * std::log(n); };

TEST(Growth, HasTheExponentOfAPowerLawAndItsRange) {
  const Growth growth = grown(sizes_over(2, 9), [](double n) { return 5 * std::pow(n, 1.5); });
  EXPECT_NEAR(growth.power.slope.value, 1.5, 1e-12);
  EXPECT_NEAR(growth.decades, 2, 1e-12);
  EXPECT_EQ(growth.sizes, 9u);
  EXPECT_NEAR(growth.scatter, 0, 1e-9);
}

TEST(Growth, TellsNFromNLogNWhereTheRangeAndTheNoiseAllow) {
  EXPECT_EQ(grown(sizes_over(2, 9), linear, 0.02).better, Law::linear);
  EXPECT_EQ(grown(sizes_over(2, 9), n_log_n, 0.02).better, Law::n_log_n);
  EXPECT_EQ(grown(sizes_over(0.3, 4), linear, 0.05).better, Law::cannot_tell);
  EXPECT_EQ(grown(sizes_over(0.3, 4), n_log_n, 0.05).better, Law::cannot_tell);
}

TEST(Growth, ScattersAsTheMeasurementsDo) {
  EXPECT_NEAR(grown(sizes_over(2, 400), linear, 0.1).scatter, 0.1, 0.015);
}

TEST(Growth, DecidesNothingOverAShortRangeWithFewSizesOrMuchScatter) {
  EXPECT_EQ(why_not_judged(grown(sizes_over(2, 8), linear), rule_for_times), "");
  EXPECT_NE(why_not_judged(grown(sizes_over(1.98, 8), linear), rule_for_times), "");
  EXPECT_NE(why_not_judged(grown(sizes_over(2, 7), linear), rule_for_times), "");
  EXPECT_NE(why_not_judged(grown(sizes_over(2, 8), linear), rule_for_work), "");
  EXPECT_EQ(why_not_judged(grown(sizes_over(3, 8), linear), rule_for_work), "");
  EXPECT_EQ(why_not_judged(grown(sizes_over(2, 40), linear, 0.1), rule_for_times), "");
  EXPECT_NE(why_not_judged(grown(sizes_over(2, 40), linear, 0.2), rule_for_times), "");
}

TEST(Growth, IsLinearIfTheWholeIntervalIsNearOne) {
  using bench::BoundTest;
  EXPECT_EQ(is_linear({1, 0.91, 1.09}), BoundTest::holds);
  EXPECT_EQ(is_linear({1, 0.89, 1.09}), BoundTest::undecided);
  EXPECT_EQ(is_linear({1, 0.91, 1.11}), BoundTest::undecided);
  EXPECT_EQ(is_linear({1.2, 1.11, 1.3}), BoundTest::fails);
  EXPECT_EQ(is_linear({0.8, 0.7, 0.89}), BoundTest::fails);
  EXPECT_EQ(is_linear(bench::without_interval(1)), BoundTest::undecided);
}

}  // namespace
}  // namespace ccdt::experiments
