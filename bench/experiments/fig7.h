#pragma once

#include "bench/experiments/experiment.h"
#include "engine/base/progress.h"

namespace ccdt {

/// Fig. 7 of the paper: the meshes of its three models, kept for pictures that show them cut open. As many tetrahedra
/// as are wanted, but not more than a picture can show.
///
/// \throw OutputError  a file of the experiment cannot be written
ExperimentResult measure_fig7(const ExperimentOptions& options, const Progress& progress = {});

}  // namespace ccdt
