#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/run/statistics.h"

namespace ccdt::gate {

/// What bounds the precision of a case, apart from the scatter of its pairs.
struct Precision {
  double timed_seconds = 0;     ///< the shortest time that the clock measured at once: a run, or all its iterations
  double clock_seconds = 0;     ///< the smallest step of the clock
  double noise_floor = 0;       ///< log ratio that an unchanged program reaches, from a calibration
  double layout_deviation = 0;  ///< standard deviation of log time between builds; 0 if it is part of the pairs
  int cases = 1;                ///< that are judged together
};

/// What a threshold follows from.
enum class ThresholdReason { relative, absolute, clock, noise, layout };

/// A slowdown as a log ratio.
struct Threshold {
  double value = 0;  ///< a case is worse if the whole interval is beyond it
  double limit = 0;  ///< a case passes only if a slowdown beyond it is excluded
  ThresholdReason reason = ThresholdReason::relative;
};

/// The verdict of pairs on one case.
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

/// Standard deviations of log time between builds of one source, as measured (docs/gates.md): of loops of
/// microseconds, and of whole runs of a program.
inline constexpr double builds_of_loops = 0.025, builds_of_programs = 0.01;

/// That of a figure: of a benchmark, or of a process.
double usual_layout_deviation(const std::string& figure);

/// Half the width of an interval.
double half_width(const bench::Estimate& estimate);

/// The largest of: the relative and the absolute threshold of the rules, two steps of the clock, what an unchanged
/// program reaches, and what two builds of one source differ by.
///
/// \param base_seconds  the median of the base
Threshold threshold_of(const TimeRules& rules, double base_seconds, const Precision& precision);

/// Would a case pass though it takes half as long again? Then its times say nothing.
bool is_blunt(const Threshold& threshold);

/// The log ratio by which builds of one source differ with a probability of 2% in at least one of these cases.
///
/// \param deviation  standard deviation of log time between builds
double layout_floor(double deviation, int cases);

/// Of pairs of one layout, the 20% trimmed mean of the log ratios with a bootstrap interval. Of pairs of several
/// layouts, the 20% trimmed mean over the layouts of the median of each, with the interval of Student's t: a layout is
/// one observation, however many pairs it has (Kalibera and Jones 2013, "Rigorous benchmarking in reasonable time").
///
/// \pre there is a pair
bench::Estimate log_ratio_of(std::span<const Pair> pairs, const bench::Bootstrap& bootstrap);

/// \param bootstrap  gives the confidence of the interval
Look look_at(std::span<const Pair> pairs, const Threshold& threshold, const bench::Bootstrap& bootstrap);

/// The number of resamples for a confidence: a few dozen lie outside the interval on each side.
bench::Bootstrap bootstrap_for(double confidence, std::uint64_t seed, int at_least = 2000);

/// The number of pairs at the next look: half as many again.
int next_look(int pairs, const TimeRules& rules);

/// The confidence of each look of a screening. All looks together let a program that is slower by the limit pass with a
/// probability of at most 1 - `confidence`.
double screening_confidence(const TimeRules& rules);

/// Bonferroni's correction: with one interval of fresh pairs for each suspect, all hold together with the confidence of
/// the rules.
double confirmation_confidence(const TimeRules& rules, int suspects);

/// The half-width of the interval at which a confirmation ends. It follows from the screening, not from the
/// confirmation's own estimate: repeated looks at that would bias it toward the result to confirm.
double wanted_half_width(const Look& screening, const TimeRules& rules);

/// The smallest slowdown, as a log ratio, that a gate with this noise finds with 95% probability: a slowdown keeps a
/// case open, so there would have been `at_most` pairs.
///
/// \param pairs       of the look
/// \param confidence  of its interval
double smallest_found(const Look& look, std::size_t pairs, double confidence, const TimeRules& rules);

/// About how many pairs a verdict would take that this look does not give.
int pairs_for_verdict(const Look& look, int pairs, const TimeRules& rules);

}  // namespace ccdt::gate
