#pragma once

#include <cstdint>
#include <limits>
#include <span>

namespace ccdt::bench {

/// The confidence of all intervals that do not name another.
inline constexpr double usual_confidence = 0.95;

/// An estimate with its confidence interval. With too few samples, the interval is infinite on both sides, so that
/// every bound is undecided.
struct Estimate {
  double value = 0, low = 0, high = 0;

  bool has_interval() const {
    return low > -std::numeric_limits<double>::infinity() && high < std::numeric_limits<double>::infinity();
  }
  bool operator==(const Estimate&) const = default;
};

inline Estimate without_interval(double value) {
  return {value, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// The result of comparing an interval with a bound.
enum class BoundTest {
  holds,      ///< all of the interval is on the right side
  undecided,  ///< the bound is inside
  fails       ///< all of the interval is on the wrong side
};
BoundTest is_at_most(const Estimate& estimate, double bound);
BoundTest is_at_least(const Estimate& estimate, double bound);

/// The width of the interval on its wider side, as a share of the value; 0 if that is 0, infinite without an interval.
double relative_spread(const Estimate& estimate);

/// How a bootstrap is drawn. The seed is fixed, so the same samples always give the same interval.
struct Bootstrap {
  double confidence = usual_confidence;
  int resamples = 4000;
  std::uint64_t seed = 20050901;
};

/// The middle sample; of an even number the mean of the two in the middle.
/// \pre there is a sample
double median(std::span<const double> samples);

/// The `fraction` quantile by linear interpolation between order statistics (type 7 of Hyndman and Fan 1996).
/// \pre there is a sample, 0 <= fraction <= 1
double quantile(std::span<const double> samples, double fraction);

/// The same without a copy: it changes the order of the samples.
double quantile_in_place(std::span<double> samples, double fraction);

/// The mean of the samples that remain when this share is dropped at each end.
/// \pre there is a sample, 0 <= share < 0.5
double trimmed_mean(std::span<const double> samples, double share);

/// The estimated standard deviation; 0 with fewer than two samples.
double standard_deviation(std::span<const double> samples);

/// The standard deviation of a normal distribution with the same median absolute deviation. Outliers do not count.
/// \pre there is a sample
double robust_deviation(std::span<const double> samples);

/// The correlation of each sample with the next; 0 with fewer than three or if all are equal.
double autocorrelation(std::span<const double> samples);

/// The trimmed mean with its percentile bootstrap interval, which covers well with heavy tails and few samples
/// (Wilcox 2017, "Introduction to Robust Estimation and Hypothesis Testing", section 4.4).
/// \pre as for `trimmed_mean`
Estimate trimmed_mean_estimate(std::span<const double> samples, double share, const Bootstrap& bootstrap = {});

/// The trimmed mean with the interval of Student's t by the winsorized variance (Tukey and McLaughlin 1963; Wilcox
/// 2017, section 4.3). For few samples, for which a bootstrap is too narrow.
///
/// \pre as for `trimmed_mean`, and at least two samples remain
Estimate trimmed_t_estimate(std::span<const double> samples, double share, double confidence = usual_confidence);

/// The value that a standard normal variable exceeds with this probability.
/// \pre 0 < probability < 1
double normal_tail(double probability);

/// The share of trials that were hits, with the interval of Clopper and Pearson (1934).
/// \pre there is a trial
Estimate share_of(std::int64_t hits, std::int64_t trials, double confidence = usual_confidence);

/// A straight line through measured points.
struct LineFit {
  Estimate slope;  ///< with its confidence interval
  double intercept = 0;
  double r_squared = 1;  ///< share of the variance that the line explains
};

/// Least squares of y over x, with the interval of Student's t for the slope (Draper and Smith 1998, section 1.4).
/// \pre as many x as y, at least 3, not all x equal
LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence = usual_confidence);

/// The same of log y over log x: the slope is the exponent of a power law.
/// \pre as for `fit_line`, and all are positive
LineFit fit_power(std::span<const double> x, std::span<const double> y, double confidence = usual_confidence);

}  // namespace ccdt::bench
