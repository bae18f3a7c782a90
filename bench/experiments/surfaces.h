#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "engine/plc/input.h"

namespace ccdt {

/// A model of the paper, with the edge length (millimetres) that makes about 100,000 tetrahedra.
struct PaperModel {
  const char* name;
  double edge_length;
};
inline constexpr std::array<PaperModel, 3> paper_models = {
    {{"piston", 2.32}, {"bracket", 1.73}, {"stepping-pole", 1.62}}};

/// A surface that experiments mesh.
struct SurfaceFile {
  std::string name;  ///< of the model, or of the user's file
  std::filesystem::path file;
  double edge_length = 0;  ///< of the model; 0: a file of the user's
};

/// Writes one of our solids for an experiment, with an edge length that is meant for 100,000 tetrahedra and changed for
/// the number that is wanted (but within the limits of the solid).
SurfaceFile write_solid(const ExperimentOptions& options, const std::string& experiment, const std::string& name,
                        double edge_length);

/// The user's files, named without their folder.
std::vector<SurfaceFile> input_files(const ExperimentOptions& options);

/// The length of the longest edge over that of the shortest; 1 if there is none.
double edge_ratio(const InputPlc& plc);

}  // namespace ccdt
