#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"
#include "engine/base/enum_names.h"

namespace ccdt::experiments {

/// One locator on one surface. Seconds are of the front.
struct LocatorsRow : CaseOutcome {
  LocatorKind locator = LocatorKind::grid;
};

enum class SurfaceKind {
  uniform,  ///< one of the paper's models
  graded,   ///< edges of very different length
  rough,    ///< some of its faces are not Delaunay
  input     ///< a file of the user's
};

constexpr auto names_of(SurfaceKind) {
  return std::to_array<NamedValue<SurfaceKind>>({{SurfaceKind::uniform, "uniform"},
                                                 {SurfaceKind::graded, "graded"},
                                                 {SurfaceKind::rough, "rough"},
                                                 {SurfaceKind::input, "input"}});
}

/// A surface, meshed with each of the locators.
struct LocatorsCase {
  std::string name;
  SurfaceKind kind = SurfaceKind::uniform;
  bool face_protection = false;
  double edge_ratio = 1;  ///< the longest edge of the surface over the shortest
  MeshCounts counts = {};
  std::vector<LocatorsRow> rows = {};  ///< grid, octree, cavity
  std::optional<bench::Estimate> octree_over_grid = {}, cavity_over_grid = {};
};

/// How fast the locators find the front's candidates.
struct Locators {
  results::Circumstances how;
  std::vector<LocatorsCase> cases;
};

/// What is expected of octree and grid on such a surface: on a graded one the octree is faster, on a uniform one the
/// grid. None for the others, and where a run failed.
std::optional<BoundTest> expectation(const LocatorsCase& locators);

/// Measures the front of the three locators: without the check on the paper's models at uniform density and on a graded
/// cube, with and without it on a rough sphere and on the files of the user.
///
/// \throw InputError   a file cannot be read
/// \throw OutputError  a file of the experiment cannot be written
Locators measure_locators(const ExperimentOptions& options, const Progress& progress = {});

/// As tables, with what they say.
results::ExperimentResult result_of(const Locators& locators);

}  // namespace ccdt::experiments
