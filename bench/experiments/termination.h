#pragma once

#include <span>
#include <string>
#include <vector>

#include "baselines/process.h"
#include "bench/experiments/experiment.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// One input whose edges were protected in one way.
struct TerminationCase {
  std::string group;          ///< the star, "solid", or "file"
  std::string input;          ///< name of the solid or file; of a star: which variant
  double degrees = 0;         ///< asked for, of a star
  double smallest_angle = 0;  ///< that segments enclose, in degrees
  Protection protection = Protection::midpoint;
  RunStatus status = RunStatus::ok;
  std::string reason = {};
  std::uint64_t steiner_vertices = 0;
  std::size_t deepest_level = 0;
  std::vector<std::string> runs = {};  ///< files, relative to the folder
};

enum class Ending {
  ended,    ///< all grazeable edges are protected
  stopped,  ///< at the limit of the engine
  unknown   ///< the run failed for another reason
};
Ending ending_of(const TerminationCase& c);

/// Does the paper's way to protect edges, inserting middle points again and again (section 2), come to an end? Protects
/// our solids, stars of segments that meet at smaller and smaller angles, and the user's files, by midpoints and by our
/// shells.
///
/// \throw OutputError  a file of the experiment cannot be written
/// \throw InputError   none of the models that were asked for is part of it
ExperimentResult measure_termination(const ExperimentOptions& options, const Progress& progress = {});

/// The result without its circumstances, and without what every result of the experiment is called.
ExperimentResult termination_result(std::span<const TerminationCase> cases);

}  // namespace ccdt
