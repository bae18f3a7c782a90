#include "bench/statistics.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace ccdt::bench {
namespace {

/// Draws with replacement. `std::uniform_int_distribution` may differ between standard libraries; a product of the
/// generator's 64 bits does not.
void resample(std::span<const double> samples, std::mt19937_64& random, std::vector<double>& drawn) {
  drawn.resize(samples.size());
  for (double& value : drawn) {
    const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
    value = samples[static_cast<std::size_t>(unit * static_cast<double>(samples.size()))];
  }
}

/// The interval between the outer percentiles of the resampled statistic.
template <class Statistic>
Estimate percentile_interval(double value, const Bootstrap& bootstrap, Statistic statistic) {
  std::mt19937_64 random(bootstrap.seed);
  std::vector<double> drawn;
  drawn.reserve(static_cast<std::size_t>(bootstrap.resamples));
  for (int i = 0; i < bootstrap.resamples; ++i) drawn.push_back(statistic(random));
  const double tail = (1 - bootstrap.confidence) / 2;
  return {value, quantile(drawn, tail), quantile(drawn, 1 - tail)};
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> logarithms(std::span<const double> values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(std::log(value));
  return result;
}

}  // namespace

double relative_spread(const Estimate& estimate) {
  const auto& [value, low, high] = estimate;
  return value > 0 ? std::max(high - value, value - low) / value : 0;
}

double quantile(std::span<const double> samples, double fraction) {
  assert(!samples.empty() && fraction >= 0 && fraction <= 1);
  std::vector<double> sorted(samples.begin(), samples.end());
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto at = [&](std::size_t i) {
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(i), sorted.end());
    return sorted[i];
  };
  const double low = at(below);
  const double weight = position - static_cast<double>(below);
  return weight == 0 ? low : low + weight * (at(below + 1) - low);
}

double median(std::span<const double> samples) {
  return quantile(samples, 0.5);
}

Estimate median_estimate(std::span<const double> samples, const Bootstrap& bootstrap) {
  std::vector<double> drawn;
  return percentile_interval(median(samples), bootstrap, [&](std::mt19937_64& random) {
    resample(samples, random, drawn);
    return median(drawn);
  });
}

Estimate ratio_of_medians(std::span<const double> numerator, std::span<const double> denominator,
                          const Bootstrap& bootstrap) {
  std::vector<double> drawn;
  return percentile_interval(median(numerator) / median(denominator), bootstrap, [&](std::mt19937_64& random) {
    resample(numerator, random, drawn);
    const double above = median(drawn);
    resample(denominator, random, drawn);
    return above / median(drawn);
  });
}

LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence) {
  assert(x.size() == y.size() && x.size() >= 3);
  const double mean_x = mean(x), mean_y = mean(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  assert(xx > 0);
  const double slope = xy / xx, intercept = mean_y - slope * mean_x;
  double unexplained = 0;  // from the residuals: a difference of the sums would lose a good fit's digits
  for (std::size_t i = 0; i < x.size(); ++i) unexplained += std::pow(y[i] - intercept - slope * x[i], 2);
  const auto freedom = static_cast<double>(x.size() - 2);
  const double t = boost::math::quantile(boost::math::students_t(freedom), (1 + confidence) / 2);
  const double half = t * std::sqrt(unexplained / freedom / xx);
  return {{slope, slope - half, slope + half}, intercept, yy > 0 ? 1 - unexplained / yy : 1};
}

LineFit fit_power(std::span<const double> x, std::span<const double> y, double confidence) {
  return fit_line(logarithms(x), logarithms(y), confidence);
}

BoundTest is_at_most(const Estimate& estimate, double bound) {
  if (estimate.high <= bound) return BoundTest::holds;
  return estimate.low > bound ? BoundTest::fails : BoundTest::undecided;
}

BoundTest is_at_least(const Estimate& estimate, double bound) {
  if (estimate.low >= bound) return BoundTest::holds;
  return estimate.high < bound ? BoundTest::fails : BoundTest::undecided;
}

}  // namespace ccdt::bench
