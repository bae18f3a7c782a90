#pragma once

#include <vector>

#include "engine/base/point.h"
#include "engine/plc/edge_table.h"

namespace ccdt::repair {

/// Triangles that face the same way as their neighbors do.
struct OrientedSurface {
  std::vector<Point3> points;
  std::vector<plc::VertexTriple> triangles;
};

/// How often an oriented surface goes around a point, counterclockwise seen from outside: 1 inside a closed surface
/// whose normals point outward, 0 outside, 2 where two solids overlap. It is a whole number where the surface is
/// closed; elsewhere it is the share of the view that the surface covers (Jacobson, Kavan, Sorkine-Hornung 2013).
///
/// \param p  not on the surface
double winding_number(const Point3& p, const OrientedSurface& surface);

}  // namespace ccdt::repair
