#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// One locator on one surface.
struct LocatorsRow {
  LocatorKind locator = LocatorKind::grid;
  std::vector<double> samples;      ///< seconds of the front in the counted runs, in order
  std::optional<Estimate> seconds;  ///< none if a run failed
  RunStatus status = RunStatus::ok;
  std::string reason;
  std::vector<std::string> runs = {};  ///< files of the runs
};

enum class SurfaceKind {
  uniform,  ///< one of the paper's models
  graded,   ///< edges of very different length
  rough,    ///< some of its faces are not Delaunay
  input     ///< a file of the user's
};

/// A surface, meshed with each of the locators.
struct LocatorsCase {
  std::string name;
  SurfaceKind kind = SurfaceKind::uniform;
  bool face_protection = false;
  double edge_ratio = 1;  ///< the longest edge of the surface over the shortest
  MeshCounts counts;
  std::vector<LocatorsRow> rows;  ///< grid, octree, cavity
  std::optional<Estimate> octree_over_grid, cavity_over_grid;
};

/// Who finds the front's candidates fastest.
struct Locators {
  Circumstances how;
  std::vector<LocatorsCase> cases;
};

/// What is expected of octree and grid on such a surface: on a graded one the octree is faster, on a uniform one the
/// grid. None for the others, and where a run failed.
std::optional<Claim> expectation(const LocatorsCase& locators);

/// Measures the front of the three locators: without the check on the paper's models at uniform density and on a graded
/// cube, with and without it on a rough sphere and on the files of the user.
///
/// \throw InputError   a file cannot be read
/// \throw OutputError  a file of the experiment cannot be written
Locators measure_locators(const ExperimentOptions& options, const Progress& progress = {});

std::string_view name_of(SurfaceKind kind);

/// As tables, with what they say.
ExperimentResult result_of(const Locators& locators);

/// What the rows mean, one sentence each.
std::vector<std::string> locators_definitions();

}  // namespace ccdt
