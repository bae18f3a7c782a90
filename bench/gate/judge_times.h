#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/gate/calibration.h"
#include "bench/gate/pair_statistics.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/rules.h"
#include "bench/gate/verdict.h"

/// From the samples of a gate to its verdicts, which depend on nothing else.
namespace ccdt::gate {

/// Describes the correction for the number of cases, for `Verdict::correction`.
std::string correction_words();

/// What limits the precision of a case of these samples.
/// \param calibration  may be null: then no threshold is raised by it
Precision precision_of(const PairedSamples& one, const SampleSet& all, const Rules& rules,
                       const Calibration* calibration);

/// Looks at the pairs of a case.
/// \pre it has some
Look screen(const PairedSamples& one, const SampleSet& all, const Rules& rules, const Calibration* calibration);

/// Looks at the new pairs of a suspect. The threshold is that of the screening.
/// \param suspects  how many there are
Look confirm(const PairedSamples& one, const Look& screening, int suspects, const Rules& rules, std::uint64_t seed);

/// The verdicts on times, on counters, and on cases that failed or that only one program has.
std::vector<JudgedFigure> judge_times(const SampleSet& samples, const Rules& rules, const Calibration* calibration);

}  // namespace ccdt::gate
