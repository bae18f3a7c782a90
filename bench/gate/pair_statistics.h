#pragma once

#include <cstdint>
#include <span>

#include "bench/gate/rules.h"
#include "bench/statistics.h"

namespace ccdt::gate {

/// The verdict of pairs on one case.
enum class Call {
  worse,      ///< the whole interval is beyond the threshold
  not_worse,  ///< the whole interval is below the threshold, or it is narrow and excludes a slowdown of the threshold
              ///< plus `largest_noise`
  open        ///< neither
};

/// One look at the log ratios of the pairs of a case.
struct Look {
  bench::Estimate log_ratio;  ///< 20% trimmed mean of log(head / base)
  double threshold = 0;       ///< the threshold, also a log ratio
  Call call = Call::open;
};

/// Is the interval too wide for a verdict? A narrow interval that contains the threshold still says that nothing large
/// has changed.
bool is_too_wide(const Look& look, const TimeRules& rules);

/// Half the width of an interval.
double half_width(const bench::Estimate& estimate);

/// The log ratio from which a case counts as worse: beyond the relative and the absolute threshold, and beyond what an
/// unchanged program reaches.
///
/// \param base_seconds  the median of the base
/// \param noise_floor   log ratio from a calibration, or 0
double threshold_of(const TimeRules& rules, double base_seconds, double noise_floor);

/// \param bootstrap  gives the confidence of the interval
Look look_at(std::span<const double> log_ratios, double threshold, const TimeRules& rules,
             const bench::Bootstrap& bootstrap);

/// The number of resamples for a confidence: a few dozen lie outside the interval on each side.
bench::Bootstrap bootstrap_for(double confidence, std::uint64_t seed, int at_least = 2000);

/// The number of pairs at the next look: half as many again.
int next_look(int pairs, const TimeRules& rules);

/// Bonferroni's correction: with one interval of fresh pairs for each suspect, all hold together with the confidence of
/// the rules.
double confirmation_confidence(const TimeRules& rules, int suspects);

/// The half-width of the interval at which a confirmation ends. It follows from the screening, not from the
/// confirmation's own estimate: repeated looks at that would bias it toward the result to confirm.
double wanted_half_width(const Look& screening, const TimeRules& rules);

}  // namespace ccdt::gate
