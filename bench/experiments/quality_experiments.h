#pragma once

#include <string>
#include <vector>

#include "bench/experiments/quality_study.h"

namespace ccdt::experiments {

/// Compares our meshes with those of other meshers at equal numbers of tetrahedra: ccdt with its FCC lattice, improved
/// and not, and with BCC; TetGen, Mesh_3 and HXT, if the build or the machine has them.
///
/// \param experiment  begins the names of its files
StudyPlan mesher_quality_plan(const ExperimentOptions& options, const std::string& experiment,
                              const std::vector<std::string>& models);

/// The paper's claim (section 3, after Radovitzky and Ortiz) that the FCC lattice makes the best tetrahedra: FCC, BCC
/// and SC at the same edge length, each before and after improvement.
StudyPlan lattices_plan();

/// What each part of the improvement does alone: nothing, swaps, smoothing, all; with the FCC lattice.
StudyPlan improvement_plan();

/// How near to the surface may lattice points be? The same surfaces with many settings, including the defaults of `ccdt
/// mesh`, with the FCC lattice and full improvement.
StudyPlan lattice_fit_plan();

}  // namespace ccdt::experiments
