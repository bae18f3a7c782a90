#pragma once

#include <span>

#include "engine/base/errors.h"
#include "engine/base/point.h"
#include "engine/plc/plc.h"

namespace ccdt::front {

/// The error that the vertices have no constrained Delaunay tetrahedralization although their surface is protected.
///
/// \param points  near the place, in grid units; none if not known
inline MeshError stuck_near(const char* what, const plc::Plc& plc, std::span<const Point3> points) {
  Place place{.file = plc.name};
  for (const Point3& p : points) place.points.push_back(as_array(plc.grid.to_world(p)));
  return {what, place, "this is a bug: please report it with the file; another --flatness may help"};
}

}  // namespace ccdt::front
