#pragma once

#include <vector>

#include "models/charts.h"
#include "models/surface.h"

namespace ccdt {

/// A piece of a surface that can be laid out in the plane, between curves that have been cut into edges.
struct Patch {
  Chart chart;
  std::vector<Chain> loops;  ///< closed, in any direction: the outer one and those of the holes
  std::vector<Chain> cuts;   ///< open curves inside that must be edges as well
  double edge_length = 1;
  int marker = 0;
};

/// Triangulates a patch with nearly equilateral triangles whose outer vertices are those of its curves: points in
/// layers, their constrained Delaunay triangulation, then smoothing towards the optimal Delaunay triangulation (Chen &
/// Xu 2004) in turn with flips.
///
/// \throw std::logic_error  the curves cross, or meet otherwise than in shared vertices
void add_patch(Surface& surface, const Patch& patch);

}  // namespace ccdt
