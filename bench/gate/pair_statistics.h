#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/run/statistics.h"

namespace ccdt::gate {

/// What limits the precision of a case, apart from the scatter of its pairs.
struct Precision {
  double timed_seconds = 0;     ///< the shortest span of time that the clock measured: a run, or all its iterations
  double clock_seconds = 0;     ///< the smallest step of the clock
  double noise_floor = 0;       ///< log ratio that an unchanged program reaches, from a calibration
  double layout_deviation = 0;  ///< standard deviation of log time between builds; 0 if it is part of the pairs
  int cases = 1;                ///< how many are judged together
};

/// What determines a threshold.
enum class ThresholdReason { relative, absolute, clock, noise, layout };

/// A slowdown as a log ratio.
struct Threshold {
  double value = 0;  ///< a case is worse if the whole interval is beyond it
  double limit = 0;  ///< a case passes only if a slowdown beyond it is excluded
  ThresholdReason reason = ThresholdReason::relative;
};

/// The verdict that the pairs give on one case.
enum class Call {
  worse,      ///< the whole interval is beyond the threshold
  not_worse,  ///< the whole interval is below the limit
  open        ///< neither
};

/// One look at the pairs of a case.
struct Look {
  bench::Estimate log_ratio;  ///< of head / base
  Threshold threshold;
  Call call = Call::open;
};

/// Measured standard deviations of log time between builds of one source (docs/gates.md): for loops of microseconds,
/// and for whole runs of a program.
inline constexpr double builds_of_loops = 0.025, builds_of_programs = 0.01;

/// The standard deviation for a figure, which is of a benchmark or of a process.
double usual_layout_deviation(const std::string& figure);

/// Half the width of an interval.
double half_width(const bench::Estimate& estimate);

/// The largest of these: the relative and the absolute threshold of the rules, two steps of the clock, the ratio that
/// an unchanged program reaches, and the difference between two builds of one source.
///
/// \param base_seconds  the median of the base
Threshold threshold_of(const TimeRules& rules, double base_seconds, const Precision& precision);

/// Would a case pass even if it took 50% longer? Then its times say nothing.
bool is_blunt(const Threshold& threshold);

/// The log ratio by which builds of one source differ with a probability of 2% in at least one of these cases.
///
/// \param deviation  standard deviation of log time between builds
double layout_floor(double deviation, int cases);

/// For pairs of one layout: the 20% trimmed mean of the log ratios, with a bootstrap interval. For several layouts: the
/// 20% trimmed mean of the layouts' medians, with the interval of Student's t. A layout is one observation, however
/// many pairs it has (Kalibera and Jones 2013, "Rigorous benchmarking in reasonable time").
///
/// \pre there is a pair
bench::Estimate log_ratio_of(std::span<const Pair> pairs, const bench::Bootstrap& bootstrap);

/// \param bootstrap  gives the confidence of the interval
Look look_at(std::span<const Pair> pairs, const Threshold& threshold, const bench::Bootstrap& bootstrap);

/// The number of resamples for a confidence. It is so large that a few dozen lie outside the interval on each side.
bench::Bootstrap bootstrap_for(double confidence, std::uint64_t seed, int at_least = 2000);

/// The number of pairs at the next look: 50% more.
int next_look(int pairs, const TimeRules& rules);

/// The confidence of each look of a screening. All looks together let a program that is slower by the limit pass with a
/// probability of at most 1 - `confidence`.
double screening_confidence(const TimeRules& rules);

/// Bonferroni's correction: each suspect gets one interval from new pairs, and all of these intervals hold together
/// with the confidence of the rules.
double confirmation_confidence(const TimeRules& rules, int suspects);

/// The half-width of the interval at which a confirmation ends. It follows from the screening, not from the
/// confirmation's own estimate: repeated looks at that would bias it toward the result to confirm.
double wanted_half_width(const Look& screening, const TimeRules& rules);

/// The smallest slowdown, as a log ratio, that a gate with this noise finds with 95% probability. It assumes `at_most`
/// pairs, because a slowdown keeps a case open.
///
/// \param pairs       of the look
/// \param confidence  of its interval
double smallest_found(const Look& look, std::size_t pairs, double confidence, const TimeRules& rules);

/// If this look gives no verdict: about how many pairs one would take.
int pairs_for_verdict(const Look& look, int pairs, const TimeRules& rules);

}  // namespace ccdt::gate
