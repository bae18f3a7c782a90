#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/gate/calibration.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/gate/timed_targets.h"
#include "bench/gate/verdict.h"
#include "engine/base/progress.h"

namespace ccdt::gate {

/// Describes the correction for the number of cases, for `Verdict::correction`.
std::string correction_words();

/// Measures base and head in turns, as long as the rules need.
///
/// Each pair has a random order, and each run an environment of random size, so that the effect of the start of the
/// stack becomes noise instead of bias (Mytkowicz et al. 2009, "Producing wrong data without doing anything obviously
/// wrong"). The cases take turns in batches of pairs. First every case is screened. Suspects are then measured again,
/// because their first times made them suspects.
///
/// \param calibration  may be null: then no threshold is raised
/// \param progress     counts pairs; their total is not known
/// \throw ProgramFailed
/// \throw baselines::Stopped
SampleSet measure_times(std::span<const TimedTarget> targets, const Rules& rules, const Calibration* calibration,
                        std::uint64_t seed, const Progress& progress);

/// The verdicts. They depend on the samples alone.
std::vector<JudgedFigure> judge_times(const SampleSet& samples, const Rules& rules, const Calibration* calibration);

}  // namespace ccdt::gate
