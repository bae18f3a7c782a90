#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// A model of the paper, with the edge length (millimeters) that makes about 100,000 tetrahedra.
struct PaperModel {
  const char* name;
  double edge_length;
};
inline constexpr std::array<PaperModel, 3> paper_models = {
    {{"piston", 2.32}, {"bracket", 1.73}, {"stepping-pole", 1.62}}};
std::vector<std::string> names_of_paper_models();

/// A surface that experiments mesh.
struct SurfaceFile {
  std::string name;  ///< of the model, or of the user's file
  std::filesystem::path file;
  double edge_length = 0;  ///< of the model; 0: a file of the user's
};

/// Writes one of our solids for an experiment. The edge length is that for 100,000 tetrahedra, scaled to the wanted
/// number within the limits of the solid.
SurfaceFile write_solid(const ExperimentOptions& options, const std::string& experiment, const std::string& name,
                        double edge_length);

/// Writes the chosen solids with multiples of their default edge lengths. A surface with the vertices of the one before
/// is left out: some solids are always the same, and others cannot get coarser.
std::vector<SurfaceFile> write_solids(const ExperimentOptions& options, const std::string& experiment,
                                      std::span<const double> coarsenings);

/// The small parts that come with the program; none if the user chose models, or they are not there.
std::vector<SurfaceFile> parts_that_come_along(const ExperimentOptions& options);

/// The user's files, named without their folder.
std::vector<SurfaceFile> input_files(const ExperimentOptions& options);

}  // namespace ccdt::experiments
