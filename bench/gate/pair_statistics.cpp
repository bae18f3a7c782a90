#include "bench/gate/pair_statistics.h"

#include <algorithm>
#include <cmath>

namespace ccdt::gate {
namespace {

constexpr double trimmed = 0.2;  ///< share at each end (Wilcox 2017, section 3.3)

}  // namespace

double half_width(const bench::Estimate& estimate) {
  return (estimate.high - estimate.low) / 2;
}

bool is_too_wide(const Look& look, const TimeRules& rules) {
  return look.call == Call::open && half_width(look.log_ratio) > rules.largest_noise;
}

double threshold_of(const TimeRules& rules, double base_seconds, double noise_floor) {
  const double absolute = base_seconds > 0 ? rules.absolute_seconds / base_seconds : 0;
  return std::max(std::log1p(std::max(rules.relative, absolute)), noise_floor);
}

Look look_at(std::span<const double> log_ratios, double threshold, const TimeRules& rules,
             const bench::Bootstrap& bootstrap) {
  Look look = {bench::trimmed_mean_estimate(log_ratios, trimmed, bootstrap), threshold};
  const double high = look.log_ratio.high;
  const bool is_narrow = half_width(look.log_ratio) <= rules.largest_noise;
  if (look.log_ratio.low > threshold)
    look.call = Call::worse;
  else if (high <= threshold || (is_narrow && high < threshold + rules.largest_noise))
    look.call = Call::not_worse;
  return look;
}

bench::Bootstrap bootstrap_for(double confidence, std::uint64_t seed, int at_least) {
  constexpr double outside = 25, most = 200000;
  const double tail = std::max((1 - confidence) / 2, outside / most);
  return {confidence, std::max(at_least, static_cast<int>(outside / tail)), seed};
}

int next_look(int pairs, const TimeRules& rules) {
  return std::min(std::max(rules.at_least, pairs + std::max(1, pairs / 2)), rules.at_most);
}

double confirmation_confidence(const TimeRules& rules, int suspects) {
  return 1 - (1 - rules.confidence) / std::max(1, suspects);
}

double wanted_half_width(const Look& screening, const TimeRules& rules) {
  // Half the distance to the threshold: the first estimate tends to be too large, because that made the case a suspect.
  const double half_way = (screening.log_ratio.value - screening.threshold) / 2;
  return std::clamp(half_way, rules.largest_noise / 2, rules.largest_noise);
}

}  // namespace ccdt::gate
