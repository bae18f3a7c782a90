#pragma once

#include <span>
#include <string>

#include "bench/experiments/experiment.h"
#include "bench/experiments/growth.h"

namespace ccdt::experiments {

/// A cube at one size, meshed without the check.
struct DensityRow : CaseRow {
  std::string density;     ///< "uniform" or "graded"
  std::string locator;     ///< "grid", the paper's, or "octree"
  double edge_length = 0;  ///< the longest, in edges of the cube
};

/// Is the work of the front linear only at uniform density (paper, sections 1, 4 and 6)? Divides exact counts of the
/// front by the number of its tetrahedra, without the check. The inputs are a cube with even edges and one whose edges
/// shrink 128-fold toward a corner, both with the paper's strategies; the second also with our octree.
ExperimentResult measure_density(const ExperimentOptions& options, bench::Runner& runner);

/// \param rows  grouped by density and locator, from the coarsest size
ExperimentResult density_result(std::span<const DensityRow> rows);

/// What a fit at graded density needs to decide that growth is steep. It need not span three decades, as a fit that is
/// called linear must: quadratic work over three decades would take a million times the work of the smallest size. The
/// sizes scatter, because the cells of the grid lie differently around the corner; the interval of the exponent
/// includes this scatter.
inline constexpr FitRule rule_for_steep_work = {.least_decades = 1, .least_sizes = 4, .most_scatter = 0.3};

}  // namespace ccdt::experiments
