#pragma once

#include <cstddef>
#include <vector>

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// What was done to gaps.
struct GapCounts {
  std::size_t split_edges = 0;   ///< at nearby vertices
  std::vector<VertexId> merged;  ///< with one nearby, and where they were
};

/// Closes narrow gaps between open edges. Vertices of open edges are merged with others nearby, the nearest first. Then
/// open edges are split at nearby vertices of other open edges.
///
/// A vertex moves by at most half the length of its shortest open edge, so no triangle collapses.
///
/// \param width  the largest distance over which things are joined, in grid units
GapCounts close_gaps(plc::UncheckedPlc& soup, double width);

}  // namespace ccdt::repair
