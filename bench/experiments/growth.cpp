#include "bench/experiments/growth.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/run/numbers.h"

namespace ccdt::experiments {
namespace {

using bench::rounded;

/// The variance that remains if log y is a given function of n plus a free constant.
template <class LogOfLaw>
double variance_around(std::span<const double> sizes, std::span<const double> y, const LogOfLaw& law) {
  std::vector<double> rest;
  for (std::size_t i = 0; i < sizes.size(); ++i) rest.push_back(std::log(y[i]) - law(sizes[i]));
  const double mean = std::accumulate(rest.begin(), rest.end(), 0.0) / static_cast<double>(rest.size());
  double sum = 0;
  for (const double r : rest) sum += (r - mean) * (r - mean);
  return sum / static_cast<double>(rest.size());
}

/// Compares likelihoods, for normal residuals. One law is better if it makes the data twenty times as likely.
Law better_law(std::span<const double> sizes, std::span<const double> y) {
  constexpr double least_ratio = 20;
  const double linear = variance_around(sizes, y, [](double n) { return std::log(n); }),
               n_log_n = variance_around(sizes, y, [](double n) { return std::log(n * std::log(n)); });
  constexpr double rounding = 1e-24;  // of an exact law
  const double log_ratio =
      0.5 * static_cast<double>(sizes.size()) * std::log((n_log_n + rounding) / (linear + rounding));
  if (std::fabs(log_ratio) < std::log(least_ratio)) return Law::cannot_tell;
  return log_ratio > 0 ? Law::linear : Law::n_log_n;
}

}  // namespace

std::string words_of(Law law) {
  switch (law) {
    case Law::linear:
      return "n";
    case Law::n_log_n:
      return "n log n";
    case Law::cannot_tell:
      break;
  }
  return "cannot tell";
}

Growth growth_of(std::span<const double> sizes, std::span<const double> y) {
  Growth growth;
  growth.power = bench::fit_power(sizes, y);
  growth.line = bench::fit_line(sizes, y);
  growth.sizes = sizes.size();
  growth.least = std::ranges::min(sizes), growth.most = std::ranges::max(sizes);
  growth.decades = std::log10(growth.most / growth.least);
  const double around = variance_around(sizes, y, [&](double n) { return growth.power.slope.value * std::log(n); });
  growth.scatter = std::sqrt(around * static_cast<double>(sizes.size()) / static_cast<double>(sizes.size() - 2));
  growth.better = better_law(sizes, y);
  return growth;
}

std::string why_not_judged(const Growth& growth, const FitRule& rule) {
  if (growth.decades < rule.least_decades)
    return rounded(growth.decades, 2) + " decades; " + rounded(rule.least_decades, 1) + " are needed";
  if (growth.sizes < rule.least_sizes)
    return std::to_string(growth.sizes) + " sizes; " + std::to_string(rule.least_sizes) + " are needed";
  if (growth.scatter > rule.most_scatter)
    return "the sizes scatter by " + rounded(100 * growth.scatter, 2) + "% around the fit; at most " +
           rounded(100 * rule.most_scatter, 2) + "% are allowed";
  return {};
}

bench::BoundTest is_linear(const bench::Estimate& exponent) {
  const bench::BoundTest above = bench::is_at_least(exponent, 1 - linear_within),
                         below = bench::is_at_most(exponent, 1 + linear_within);
  if (above == bench::BoundTest::fails || below == bench::BoundTest::fails) return bench::BoundTest::fails;
  return above == bench::BoundTest::holds ? below : above;
}

std::optional<Fit> fit_of(std::string quantity, std::span<const double> sizes, std::span<const double> values,
                          const FitRule& rule) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] <= 1 || values[i] <= 0) continue;
    x.push_back(sizes[i]);
    y.push_back(values[i]);
  }
  if (x.size() < 3 || std::ranges::min(x) == std::ranges::max(x)) return {};
  Fit fit{std::move(quantity), growth_of(x, y)};
  fit.not_judged = why_not_judged(fit.growth, rule);
  return fit;
}

results::RowColumns<Fit> growth_columns(results::Column (*number_column)(std::string, std::string, std::string)) {
  return {{results::figure_column("sizes"), [](const Fit& fit) { return std::uint64_t{fit.growth.sizes}; }},
          {results::figure_column("decades"), [](const Fit& fit) { return fit.growth.decades; }},
          {number_column("exponent", "", ""), [](const Fit& fit) { return fit.growth.power.slope; }},
          {number_column("scatter", "", ""), [](const Fit& fit) { return fit.growth.scatter; }}};
}

results::RowColumns<Fit> verdict_columns() {
  return {{results::label_column("judged"), &Fit::is_judged},
          {results::note_column("why_not", "why it is not judged"), &Fit::not_judged}};
}

}  // namespace ccdt::experiments
