#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/errors.h"

namespace ccdt::front {

/// Why the vertices have no constrained Delaunay tetrahedralization: a facet that is flat only within the tolerance
/// bends away from a line of sight.
struct Stuck {
  MeshError error;
  std::vector<std::uint32_t> faces = {};  ///< of the facets, ascending: they may be the cause; none: not known
};

}  // namespace ccdt::front
