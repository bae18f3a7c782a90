#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "bench/gate/calibration.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/gate/timed_targets.h"

namespace ccdt::gate {

/// How far a measurement is.
struct TimeProgress {
  std::size_t decided = 0, cases = 0;
  std::uint64_t pairs = 0;     ///< done
  std::uint64_t expected = 0;  ///< pairs in all, estimated from the noise so far
};

/// What `measure_times` needs besides the targets and the rules.
struct MeasureOptions {
  const Calibration* calibration = nullptr;  ///< null: no threshold is raised by it
  double most_seconds = 0;                   ///< of one run; 0: many times what the base took at first
  std::function<void(const TimeProgress&)> progress = {};
};

/// Measures base and head in turns, for as long as the rules require.
///
/// Each pair has a random order, and each run an environment of random size, so that the effect of the start of the
/// stack becomes noise instead of bias (Mytkowicz et al. 2009, "Producing wrong data without doing anything obviously
/// wrong"). The cases take turns in batches of pairs. First every case is screened. Suspects are then measured again,
/// because their first times made them suspects.
///
/// Programs that are rebuilt get a new layout every few pairs. The confirmation has layouts that the screening did not
/// see. A case on which a program fails is left out, with the reason; the others go on.
///
/// \param samples  has the seed, the clock and the programs, and no cases at first. With the cases of a stopped
///                 measurement, the measurement continues. If the user stops the program, it holds what was measured.
/// \throw baselines::Stopped
void measure_times(std::span<const TimedTarget> targets, const Rules& rules, const MeasureOptions& options,
                   SampleSet& samples);

/// The smallest step of the clock that programs measure with, in seconds.
double clock_step();

}  // namespace ccdt::gate
