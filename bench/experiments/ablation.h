#pragma once

#include "bench/experiments/quality_study.h"

namespace ccdt {

/// What each part of the improvement does alone: nothing, swaps, smoothing, all.
struct Ablation : QualityStudy {};

/// Measures the four on every surface, with the FCC lattice, at about 50,000 tetrahedra.
///
/// \throw InputError, OutputError  as `measure_study`
Ablation measure_ablation(const ExperimentOptions& options, const Progress& progress = {});

/// As JSON of schema `ccdt.ablation/1`.
std::string to_json(const Ablation& ablation);

/// What the rows mean, one sentence each.
std::vector<std::string> ablation_definitions();

}  // namespace ccdt
