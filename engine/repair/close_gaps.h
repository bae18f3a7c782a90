#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"

namespace ccdt::repair {

/// What was done to gaps.
struct GapCounts {
  std::size_t merged_vertices = 0;  ///< moved to another one nearby
  std::size_t split_edges = 0;      ///< at vertices beside them
};

/// Closes narrow gaps between open edges. Vertices of open edges are merged with others nearby, the nearest first. Then
/// open edges are split at the vertices of other open edges that are beside them.
///
/// A vertex moves at most half as far as the shortest open edge at it is long, so no triangle collapses.
///
/// \param width  the largest distance between what is joined, in grid units
GapCounts close_gaps(plc::UncheckedPlc& soup, double width);

}  // namespace ccdt::repair
