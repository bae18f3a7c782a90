#pragma once

#include "engine/base/progress.h"
#include "engine/base/stage_scope.h"
#include "engine/options/mesh_options.h"
#include "engine/sizes/wanted_sizes.h"

namespace ccdt::steps {

/// What the steps of a run share.
struct Run {
  MeshOptions options;
  const Progress& progress;
  StageCosts costs = {};
  sizes::WantedSizes wanted = {};
  MeshCounts counts = {};

  /// Runs a part of a step, and adds its cost to that of the stage.
  template <class Part>
  auto measured(Stage stage, const Part& part) {
    const StageScope scope(costs[stage]);
    return part();
  }
};

}  // namespace ccdt::steps
