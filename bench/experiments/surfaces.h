#pragma once

#include <string>

#include "bench/experiments/experiment.h"
#include "engine/plc/input.h"

namespace ccdt {

/// A surface that experiments mesh.
struct SurfaceFile {
  std::string name;  ///< of the model, or of the user's file
  std::filesystem::path file;
  double edge_length = 0;  ///< of the model; 0: a file of the user's
};

/// Writes one of our solids, with its edge length times the scale (but within the limits of the solid), for an
/// experiment.
SurfaceFile write_solid(const ExperimentOptions& options, const std::string& experiment, const std::string& name,
                        double edge_length);

/// The length of the longest edge over that of the shortest; 1 if there is none.
double edge_ratio(const InputPlc& plc);

}  // namespace ccdt
