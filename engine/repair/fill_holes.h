#pragma once

#include <cstddef>
#include <vector>

#include "engine/plc/build_plc.h"
#include "engine/repair/certify.h"
#include "engine/repair/open_edges.h"

namespace ccdt::repair {

/// What was done to holes.
struct FilledHoles {
  std::vector<Lid> lids;
  std::vector<std::vector<VertexId>> rims;  ///< of the lids
  std::size_t left_open = 0;                ///< holes whose lids would reach too far
  double farthest = 0;                      ///< how far those lids would reach

  std::size_t triangles() const;  ///< of the lids
};

/// Fills each loop of open edges as a polygon: a flat one by a triangulation in its plane, any other so that it bends
/// least (`plc::triangulate_warped_facets`).
///
/// \param reach  the largest distance of a lid from its rim, in grid units. Other holes stay open
FilledHoles fill_holes(plc::UncheckedPlc& soup, Rims which, double reach);

}  // namespace ccdt::repair
