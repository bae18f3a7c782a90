#pragma once

#include <cstdint>
#include <span>

#include "bench/gate/rules.h"
#include "bench/statistics.h"

namespace ccdt::gate {

/// What pairs say of one case.
enum class Call {
  worse,      ///< all of the interval is beyond the threshold
  not_worse,  ///< all of it is below, or it is narrow and excludes a slowdown of threshold and `largest_noise` together
  open        ///< neither
};

/// The log ratios of the pairs of a case, looked at once.
struct Look {
  bench::Estimate log_ratio;  ///< 20% trimmed mean of log(head / base)
  double threshold = 0;       ///< that it is compared with, a log ratio too
  Call call = Call::open;
};

/// Is the interval too wide for a verdict? One that contains the threshold still says that nothing large has changed,
/// if it is narrow.
bool is_too_wide(const Look& look, const TimeRules& rules);

/// Half the width of an interval.
double half_width(const bench::Estimate& estimate);

/// The log ratio from which a case counts as worse: beyond the relative and the absolute threshold, and beyond what an
/// unchanged program reaches.
///
/// \param base_seconds  the median of the base
/// \param noise_floor   log ratio from a calibration, or 0
double threshold_of(const TimeRules& rules, double base_seconds, double noise_floor);

/// \param bootstrap  its confidence is that of the interval
Look look_at(std::span<const double> log_ratios, double threshold, const TimeRules& rules,
             const bench::Bootstrap& bootstrap);

/// Enough resamples for a confidence: a few dozen lie outside the interval on each side.
bench::Bootstrap bootstrap_for(double confidence, std::uint64_t seed, int at_least = 2000);

/// How many pairs there are at the next look: half as many more.
int next_look(int pairs, const TimeRules& rules);

/// Bonferroni's: of as many intervals of fresh pairs as there are suspects, all hold with the confidence of the rules.
double confirmation_confidence(const TimeRules& rules, int suspects);

/// Half the width of the interval at which a confirmation ends. It follows from the screening and not from the
/// confirmation's own estimate: looking at that repeatedly would make it lean towards what it is to confirm.
double wanted_half_width(const Look& screening, const TimeRules& rules);

}  // namespace ccdt::gate
