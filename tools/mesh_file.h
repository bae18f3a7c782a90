#pragma once

#include <string>

#include "baselines/mesher_options.h"
#include "bench/run/requirements.h"
#include "bench/run/run_record.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"
#include "engine/surface/mark_by_angle.h"
#include "tools/last_record.h"

namespace ccdt::tools {

/// What `ccdt mesh` was asked for.
struct MeshCommand {
  std::string input, output, report;
  std::string input_format;    ///< empty: that of its extension or its first word
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

/// The record of a run that has not read its input yet.
bench::RunRecord begin_record(const MeshCommand& command);

/// Reads, meshes, measures and writes.
///
/// \param record  begun; at every moment, it contains what is known of the run
/// \param last    gets the record whenever more is known of the run
/// \throw ...     what reading, meshing and writing throw
void mesh_file(const MeshCommand& command, bench::RunRecord& record, LastRecord& last, const Progress& progress);

}  // namespace ccdt::tools
