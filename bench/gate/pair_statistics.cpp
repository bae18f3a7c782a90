#include "bench/gate/pair_statistics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ccdt::gate {
namespace {

constexpr double clock_steps = 2;          ///< a time is the difference of two readings
constexpr double bluntest = 0.5;           ///< largest slowdown that a threshold may let pass
constexpr double layout_alarms = 0.02;     ///< share of gates with a false alarm because of layouts
constexpr double wanted_power = 0.95;      ///< share of gates that find the smallest slowdown
constexpr std::size_t fewest_layouts = 4;  ///< with fewer, nothing is trimmed, and Student's t is very wide

/// The median log ratio of each layout.
std::vector<double> by_layout(std::span<const Pair> pairs) {
  std::map<int, std::vector<double>> layouts;
  const std::vector<double> ratios = log_ratios(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) layouts[pairs[i].layout].push_back(ratios[i]);
  std::vector<double> medians;
  for (const auto& [layout, values] : layouts) medians.push_back(bench::median(values));
  return medians;
}

}  // namespace

double usual_layout_deviation(const std::string& figure) {
  return figure == "real_time" || figure == "cpu_time" ? builds_of_loops : builds_of_programs;
}

double half_width(const bench::Estimate& estimate) {
  return (estimate.high - estimate.low) / 2;
}

double layout_floor(double deviation, int cases) {
  return bench::normal_tail(layout_alarms / std::max(1, cases)) * std::sqrt(2.0) * deviation;
}

Threshold threshold_of(const TimeRules& rules, double base_seconds, const Precision& precision) {
  const auto share = [](double part, double whole) { return whole > 0 ? std::log1p(part / whole) : 0; };
  const std::pair<double, ThresholdReason> all[] = {
      {std::log1p(rules.relative), ThresholdReason::relative},
      {share(rules.absolute_seconds, base_seconds), ThresholdReason::absolute},
      {share(clock_steps * precision.clock_seconds, precision.timed_seconds), ThresholdReason::clock},
      {precision.noise_floor, ThresholdReason::noise},
      {layout_floor(precision.layout_deviation, precision.cases), ThresholdReason::layout}};
  const auto& [value, reason] = *std::ranges::max_element(all, {}, &std::pair<double, ThresholdReason>::first);
  return {value, std::log1p(std::expm1(value) + rules.largest_noise), reason};
}

bool is_blunt(const Threshold& threshold) {
  return threshold.value > std::log1p(bluntest);
}

bench::Estimate log_ratio_of(std::span<const Pair> pairs, const bench::Bootstrap& bootstrap) {
  const std::vector<double> layouts = by_layout(pairs);
  if (layouts.size() >= fewest_layouts) return bench::trimmed_t_estimate(layouts, trimmed_share, bootstrap.confidence);
  return bench::trimmed_mean_estimate(log_ratios(pairs), trimmed_share, bootstrap);
}

Look look_at(std::span<const Pair> pairs, const Threshold& threshold, const bench::Bootstrap& bootstrap) {
  Look look = {log_ratio_of(pairs, bootstrap), threshold};
  if (look.log_ratio.low > threshold.value)
    look.call = Call::worse;
  else if (look.log_ratio.high <= threshold.limit && !is_blunt(threshold))
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

double screening_confidence(const TimeRules& rules) {
  constexpr double looks = 4;  // the errors of several looks overlap; the test of passing simulates them
  return 1 - (1 - rules.confidence) / looks;
}

double confirmation_confidence(const TimeRules& rules, int suspects) {
  return 1 - (1 - rules.confidence) / std::max(1, suspects);
}

double wanted_half_width(const Look& screening, const TimeRules& rules) {
  // Half the distance to the threshold: the first estimate tends to be too large, because that made the case a suspect.
  const double half_way = (screening.log_ratio.value - screening.threshold.value) / 2;
  return std::clamp(half_way, rules.largest_noise / 2, rules.largest_noise);
}

double smallest_found(const Look& look, std::size_t pairs, double confidence, const TimeRules& rules) {
  const double in_errors = bench::normal_tail((1 - confidence) / 2), power = bench::normal_tail(1 - wanted_power);
  const double narrowed =
      std::sqrt(static_cast<double>(pairs) / std::max<double>(rules.at_most, static_cast<double>(pairs)));
  return look.threshold.value + half_width(look.log_ratio) * narrowed * (1 + power / in_errors);
}

int pairs_for_verdict(const Look& look, int pairs, const TimeRules& rules) {
  const double value = look.log_ratio.value;
  // The interval must end below the limit, or begin above the threshold. An estimate in the middle may move.
  const double distance =
      std::max({look.threshold.limit - value, value - look.threshold.value, rules.largest_noise / 4});
  const double needed = pairs * std::pow(half_width(look.log_ratio) / distance, 2);
  return static_cast<int>(std::min(std::max(std::ceil(1.2 * needed), pairs * 1.5), 1e6));
}

}  // namespace ccdt::gate
