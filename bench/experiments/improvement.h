#pragma once

#include "bench/experiments/quality_study.h"

namespace ccdt {

/// What each part of the improvement does alone: nothing, swaps, smoothing, all.
struct ImprovementParts : QualityStudy {};

/// Measures the four on every surface, with the FCC lattice.
///
/// \throw InputError, OutputError  as `measure_study`
ImprovementParts measure_improvement(const ExperimentOptions& options, const Progress& progress = {});

/// As tables.
ExperimentResult result_of(const ImprovementParts& parts);

/// What the rows mean, one sentence each.
std::vector<std::string> improvement_definitions();

}  // namespace ccdt
