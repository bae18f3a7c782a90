#include "bench/run/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace ccdt::bench {
namespace {

/// Without `long double`: Valgrind does not support its range, and tables that Boost fills at the start would overflow.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

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

std::vector<double> sorted(std::span<const double> samples) {
  std::vector<double> result(samples.begin(), samples.end());
  std::ranges::sort(result);
  return result;
}

/// The number of samples dropped at each end.
std::size_t trimmed_at_each_end(std::size_t samples, double share) {
  return static_cast<std::size_t>(share * static_cast<double>(samples));
}

/// The trimmed mean of a sample in which each of these values, which are in order, occurs this many times.
double trimmed_mean_of_counts(std::span<const double> values, std::span<const std::uint32_t> times, double share) {
  const std::size_t trimmed = trimmed_at_each_end(values.size(), share), end = values.size() - trimmed;
  double sum = 0;
  std::size_t before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = std::max(before, trimmed), last = std::min(before + times[i], end);
    if (last > first) sum += static_cast<double>(last - first) * values[i];
    before += times[i];
  }
  return sum / static_cast<double>(end - trimmed);
}

/// Half the width of a confidence interval, in standard errors.
double student_t(double freedom, double confidence) {
  return boost::math::quantile(boost::math::students_t_distribution<double, InDouble>(freedom), (1 + confidence) / 2);
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

double quantile_in_place(std::span<double> samples, double fraction) {
  assert(!samples.empty() && fraction >= 0 && fraction <= 1);
  const double position = fraction * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto at = samples.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(samples.begin(), at, samples.end());
  const double low = *at, weight = position - static_cast<double>(below);
  return weight == 0 ? low : low + weight * (*std::min_element(at + 1, samples.end()) - low);
}

double quantile(std::span<const double> samples, double fraction) {
  std::vector<double> copy(samples.begin(), samples.end());
  return quantile_in_place(copy, fraction);
}

double median(std::span<const double> samples) {
  return quantile(samples, 0.5);
}

double trimmed_mean(std::span<const double> samples, double share) {
  assert(!samples.empty() && share >= 0 && share < 0.5);
  const std::size_t trimmed = trimmed_at_each_end(samples.size(), share);
  const std::vector<double> in_order = sorted(samples);
  return mean(std::span(in_order).subspan(trimmed, samples.size() - 2 * trimmed));
}

double standard_deviation(std::span<const double> samples) {
  if (samples.size() < 2) return 0;
  const double center = mean(samples);
  double sum = 0;
  for (const double sample : samples) sum += (sample - center) * (sample - center);
  return std::sqrt(sum / static_cast<double>(samples.size() - 1));
}

double robust_deviation(std::span<const double> samples) {
  constexpr double of_normal = 1.482602218505602;  // 1 / the third quartile of the normal distribution
  const double center = median(samples);
  std::vector<double> distances;
  distances.reserve(samples.size());
  for (const double sample : samples) distances.push_back(std::abs(sample - center));
  return of_normal * median(distances);
}

double autocorrelation(std::span<const double> samples) {
  if (samples.size() < 3) return 0;
  const double center = mean(samples);
  double next = 0, own = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    own += (samples[i] - center) * (samples[i] - center);
    if (i > 0) next += (samples[i] - center) * (samples[i - 1] - center);
  }
  return own > 0 ? next / own : 0;
}

Estimate trimmed_mean_estimate(std::span<const double> samples, double share, const Bootstrap& bootstrap) {
  const std::vector<double> in_order = sorted(samples);
  std::vector<std::uint32_t> times(samples.size());
  return percentile_interval(trimmed_mean(samples, share), bootstrap, [&](std::mt19937_64& random) {
    std::ranges::fill(times, 0);
    for (std::size_t i = 0; i < samples.size(); i += 2) {
      const std::uint64_t bits = random();  // half of them for each of two draws
      ++times[(bits >> 32) * samples.size() >> 32];
      if (i + 1 < samples.size()) ++times[(bits & 0xffffffff) * samples.size() >> 32];
    }
    return trimmed_mean_of_counts(in_order, times, share);
  });
}

Estimate trimmed_t_estimate(std::span<const double> samples, double share, double confidence) {
  const std::size_t trimmed = trimmed_at_each_end(samples.size(), share), kept = samples.size() - 2 * trimmed;
  assert(kept >= 2);
  std::vector<double> winsorized = sorted(samples);
  std::fill_n(winsorized.begin(), trimmed, winsorized[trimmed]);
  std::fill_n(winsorized.rbegin(), trimmed, winsorized[samples.size() - trimmed - 1]);
  const auto all = static_cast<double>(samples.size()), remain = static_cast<double>(kept);
  const double error = standard_deviation(winsorized) * std::sqrt(all - 1) / std::sqrt(remain * (remain - 1));
  const double value = trimmed_mean(samples, share), half = student_t(remain - 1, confidence) * error;
  return {value, value - half, value + half};
}

double normal_tail(double probability) {
  using Normal = boost::math::normal_distribution<double, InDouble>;
  return boost::math::quantile(boost::math::complement(Normal(), probability));
}

Estimate share_of(std::int64_t hits, std::int64_t trials, double confidence) {
  assert(hits >= 0 && hits <= trials && trials > 0);
  using Binomial = boost::math::binomial_distribution<double, InDouble>;
  const auto all = static_cast<double>(trials), some = static_cast<double>(hits);
  const double tail = (1 - confidence) / 2;
  return {some / all, Binomial::find_lower_bound_on_p(all, some, tail),
          Binomial::find_upper_bound_on_p(all, some, tail)};
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
  double unexplained = 0;  // from the residuals: a difference of sums would lose digits for a good fit
  for (std::size_t i = 0; i < x.size(); ++i) unexplained += std::pow(y[i] - intercept - slope * x[i], 2);
  const auto freedom = static_cast<double>(x.size() - 2);
  const double half = student_t(freedom, confidence) * std::sqrt(unexplained / freedom / xx);
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
