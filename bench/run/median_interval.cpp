#include "bench/run/median_interval.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cassert>

namespace ccdt::bench {
namespace {

/// Without `long double`, as in bench/run/statistics.cpp.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using FairCoin = boost::math::binomial_distribution<double, InDouble>;

/// An interval by its rank, and the probability that it misses the median.
struct RankedInterval {
  int rank = 0;
  double error = 0;
};

/// The narrowest interval that misses with at most this probability. Begins at the middle, where the sum of the
/// binomial probabilities is known.
RankedInterval narrowest(int samples, double error) {
  const double allowed = error / 2 * (1 + 1e-9);  // rounding must not cost a rank
  const FairCoin coin(samples, 0.5);
  int below = (samples - 1) / 2;
  double tail = samples % 2 == 1 ? 0.5 : (1 - pdf(coin, samples / 2)) / 2;  // P(B <= below)
  for (double probability = pdf(coin, below); below >= 0 && tail > allowed; --below) {
    tail -= probability;
    probability *= static_cast<double>(below) / (samples - below + 1);
  }
  return below < 0 ? RankedInterval() : RankedInterval{below + 1, 2 * tail};
}

/// The error that all looks may have together, up to the one with this many samples. A part is kept for later looks,
/// except at the last look, or if the run was interrupted between two looks.
double error_until(int samples, std::span<const int> looks) {
  const double all = 1 - usual_confidence;
  const auto look = std::ranges::find(looks, samples);
  const bool is_last = look == looks.end() || look + 1 == looks.end();
  return is_last ? all : all * (1 - 2.25 / samples);  // of six samples 1/32, which is what their range needs
}

}  // namespace

std::vector<int> looks_between(int at_least, int at_most) {
  assert(1 <= at_least && at_least <= at_most);
  std::vector<int> looks;
  for (int look = std::max(at_least, fewest_for_interval); look < at_most; look *= 3)
    if (looks.empty() || 2 * look <= at_most) looks.push_back(look);  // a look shortly before the last gains nothing
  looks.push_back(at_most);
  return looks;
}

int rank_of_interval(int samples, std::span<const int> looks) {
  if (samples < fewest_for_interval) return 0;
  double spent = 0;
  for (const int look : looks)
    if (look < samples) spent += narrowest(look, error_until(look, looks) - spent).error;
  return narrowest(samples, error_until(samples, looks) - spent).rank;
}

Estimate median_estimate(std::span<const double> samples, std::span<const int> looks) {
  const auto rank = static_cast<std::size_t>(rank_of_interval(static_cast<int>(samples.size()), looks));
  if (rank == 0) return without_interval(median(samples));
  std::vector<double> sorted(samples.begin(), samples.end());
  std::ranges::sort(sorted);
  return {median(sorted), sorted[rank - 1], sorted[sorted.size() - rank]};
}

Estimate median_ratio(std::span<const double> numerator, std::span<const double> denominator,
                      std::span<const int> looks) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(numerator.size(), denominator.size()); ++i)
    ratios.push_back(numerator[i] / denominator[i]);
  return median_estimate(ratios, looks);
}

}  // namespace ccdt::bench
