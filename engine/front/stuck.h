#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::front {

/// Why the vertices have no constrained Delaunay tetrahedralization: a facet that is flat only within the tolerance
/// bends away from a line of sight.
struct Stuck {
  MeshError error;
  std::vector<std::uint32_t> faces = {};  ///< of the facets, ascending: they may be the cause; none: not known
};

/// \param points  near the place, in grid units; none: not known
inline Stuck stuck_near(const char* what, const plc::Plc& plc, std::span<const Point3> points) {
  Place place{.file = plc.name};
  for (const Point3& p : points) place.points.push_back(as_array(plc.grid.to_world(p)));
  return {MeshError(what, place,
                    points.empty()
                        ? "some facets are almost but not quite flat: try another --flatness"
                        : "the facets near these points are almost but not quite flat: try another --flatness")};
}

}  // namespace ccdt::front
