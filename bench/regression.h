#pragma once

#include <span>

#include "bench/statistics.h"

namespace ccdt {

/// A straight line through measured points.
struct LineFit {
  Estimate slope;  ///< with its confidence interval
  double intercept = 0;
  double r_squared = 1;  ///< share of the variance that the line explains
};

/// Least squares of y over x, with the interval of Student's t for the slope (Draper and Smith 1998, section 1.4).
/// \pre as many x as y, at least 3, not all x equal
LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

/// The same of log y over log x: the slope is the exponent of a power law.
/// \pre as for `fit_line`, and all are positive
LineFit fit_power(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

}  // namespace ccdt
