#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/results/row_columns.h"
#include "bench/run/statistics.h"

namespace ccdt::experiments {

/// Which of two laws, each with one free factor, describes measurements better.
enum class Law { linear, n_log_n, cannot_tell };

/// "n", "n log n" or "cannot tell".
std::string words_of(Law law);

/// How something grows with the size n of the input.
struct Growth {
  bench::LineFit power = {};  ///< log y over log n; the slope is the exponent
  bench::LineFit line = {};   ///< y over n
  std::size_t sizes = 0;
  double least = 0, most = 0;  ///< size
  double decades = 0;          ///< log10 of the largest size over the smallest
  double scatter = 0;          ///< standard deviation of y around the power law, as a share
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

/// How a quantity grows in a series of runs.
struct Fit {
  std::string quantity;
  Growth growth = {};
  std::string not_judged = {};  ///< why

  bool is_judged() const { return not_judged.empty(); }
};

/// The fit of the points at which both numbers are large enough: the size greater than 1, the value positive. None with
/// fewer than three, or if all sizes are equal.
std::optional<Fit> fit_of(std::string quantity, std::span<const double> sizes, std::span<const double> values,
                          const FitRule& rule);

/// \name Columns of fits. The numbers of fits of times change with the machine, so these are no figures.
/// @{
results::RowColumns<Fit> growth_columns(results::Column (*number_column)(std::string, std::string, std::string));
results::RowColumns<Fit> verdict_columns();
/// @}

}  // namespace ccdt::experiments
