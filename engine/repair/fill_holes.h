#pragma once

#include <cstddef>

#include "engine/plc/build_plc.h"
#include "engine/repair/open_edges.h"

namespace ccdt::repair {

/// What was done to holes.
struct HoleCounts {
  std::size_t filled = 0;
  std::size_t triangles = 0;  ///< that fill them
};

/// Fills each loop of open edges as a polygon: a flat one by a triangulation in its plane, any other so that it bends
/// least (`plc::triangulate_warped_facets`).
HoleCounts fill_holes(plc::UncheckedPlc& soup, Rims which = Rims::of_holes);

}  // namespace ccdt::repair
