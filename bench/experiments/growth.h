#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/run/statistics.h"

namespace ccdt::experiments {

/// Which of two laws, each with one free factor, describes measurements better.
enum class Law { linear, n_log_n, cannot_tell };

/// "n", "n log n" or "cannot tell".
std::string words_of(Law law);

/// How something grows with the size n of the input.
struct Growth {
  bench::LineFit power = {};  ///< log y over log n; the slope is the exponent
  std::size_t sizes = 0;
  double decades = 0;  ///< log10 of the largest size over the smallest
  double scatter = 0;  ///< standard deviation of y around the power law, as a share
  Law better = Law::cannot_tell;
};

/// \pre at least three sizes, not all equal; all are greater than 1, and all y are positive
Growth growth_of(std::span<const double> sizes, std::span<const double> y);

/// What a fit needs to decide a claim.
struct FitRule {
  double least_decades;
  std::size_t least_sizes = 8;
  double most_scatter = 0.15;
};
inline constexpr FitRule rule_for_times = {2}, rule_for_work = {3};

/// Why the fit decides nothing: "1.3 decades; 2 are needed". Empty if it decides.
std::string why_not_judged(const Growth& growth, const FitRule& rule);

/// Growth is linear if the whole interval of the exponent is not farther than this from 1.
inline constexpr double linear_within = 0.1;

/// Growth is nearly linear, or slower, if the whole interval of the exponent is at most this.
inline constexpr double nearly_linear = 1.2;

bench::BoundTest is_linear(const bench::Estimate& exponent);

}  // namespace ccdt::experiments
