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

/// How the number of cases is accounted for, in words for `Verdict::correction`.
std::string correction_words();

/// Measures base and head in turns, as long as the rules need.
///
/// Each pair has a random order, and each run an environment of random size, so that what depends on where the stack
/// begins becomes noise instead of bias (Mytkowicz et al. 2009, "Producing wrong data without doing anything obviously
/// wrong"). The cases take turns in batches of pairs. First every case is screened; the suspects are then measured
/// afresh, since the first times were what made them suspects.
///
/// \param calibration  may be null: no case's threshold is raised
/// \param progress     counts pairs; nobody knows how many there will be
/// \throw ProgramFailed
/// \throw baselines::Stopped
SampleSet measure_times(std::span<const TimedTarget> targets, const Rules& rules, const Calibration* calibration,
                        std::uint64_t seed, const Progress& progress);

/// The verdicts, which follow from the samples alone: of equal samples always the same.
std::vector<JudgedFigure> judge_times(const SampleSet& samples, const Rules& rules, const Calibration* calibration);

}  // namespace ccdt::gate
