#pragma once

#include <exception>
#include <string>

#include "baselines/mesher_options.h"
#include "bench/run/requirements.h"
#include "bench/run/run_record.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"
#include "engine/surface/mark_by_angle.h"

namespace ccdt::tools {

/// What `ccdt mesh` was asked for.
struct MeshCommand {
  std::string input, output, report;
  std::string format;          ///< of the output; empty: that of its extension
  int order = 1;               ///< of the elements in the output
  int partitions = 0;          ///< of the tetrahedra in the output; 0: none
  std::string surface_output;  ///< file for the remeshed or repaired surface
  bool repair = false;         ///< before meshing
  surface::MarkerSource markers = surface::MarkerSource::file;
  std::string mesher = "ccdt";
  MeshOptions options;
  bench::Requirements required;
  baselines::Strategies strategies = baselines::Strategies::usual;
  baselines::NamedOptions given;  ///< the options on the command line
};

/// Reads, meshes, measures and writes. At every moment, the record contains what is known of the run.
///
/// \throw ...  what reading, meshing and writing throw
void mesh_file(const MeshCommand& command, bench::RunRecord& record, const Progress& progress);

/// Notes in the record that the run has failed.
void record_failure(const MeshCommand& command, bench::RunRecord& record, const std::exception& error);

}  // namespace ccdt::tools
