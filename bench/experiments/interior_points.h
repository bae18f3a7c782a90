#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/interior_existence.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// Which rules keep interior points away from the surface.
enum class InteriorRule {
  paper,         ///< none in the smallest sphere of a face or subsegment, and our clearance
  no_spheres,    ///< our clearance alone
  no_distances,  ///< neither: a hundredth of the edge length from the surface is far enough
};

/// One input with one lattice under one rule.
struct InteriorCase {
  std::string input;
  double edge_length = 0;  ///< of one of our solids; 0: a file
  Lattice lattice = Lattice::fcc;
  InteriorRule rule = InteriorRule::paper;
  std::uint64_t placed = 0;   ///< interior vertices of the mesh
  std::uint64_t dropped = 0;  ///< points that would have destroyed a protected edge
  RunStatus status = RunStatus::ok;
  std::string reason;
  std::vector<std::string> runs = {};  ///< files of the runs
};

/// What became of the interior points of all inputs.
struct InteriorPoints {
  Circumstances how;
  std::vector<InteriorCase> cases;
  std::vector<ExistenceTrials> existence;
};

/// A rule over all its cases that went well.
struct InteriorSummary {
  std::uint64_t cases = 0, harmed = 0, failed = 0;  ///< `harmed`: with a dropped point
  std::uint64_t placed = 0, dropped = 0;
};
InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule);
InteriorSummary summarize(std::span<const InteriorCase> cases, InteriorRule rule, Lattice lattice);

/// Tests what the paper says in section 3, that interior points never do harm: by exhaustion on small PLCs, and meshes
/// all solids at several edge lengths, and the files of the user, with all lattices and rules; each once, for the
/// counts are always the same.
///
/// \throw OutputError  a file of the experiment cannot be written
InteriorPoints measure_interior_points(const ExperimentOptions& options, const Progress& progress = {});

std::string_view name_of(InteriorRule rule);

/// As tables, with what they say.
ExperimentResult result_of(const InteriorPoints& points);

/// What the rows mean, one sentence each.
std::vector<std::string> interior_points_definitions();

}  // namespace ccdt
