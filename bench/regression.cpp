#include "bench/regression.h"

#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace ccdt {
namespace {

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

}  // namespace ccdt
