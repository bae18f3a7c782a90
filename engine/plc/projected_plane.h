#pragma once

#include <array>
#include <span>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/geometry/grid.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt::plc {

/// The plane of a facet, seen along the axis nearest to its normal. In this projection, all answers are exact, even for
/// a facet that is planar only within the tolerance.
struct ProjectedPlane {
  std::span<const Point3> vertices;
  std::span<const Point3> seeds;  ///< their ids follow those of the vertices
  int axis = 2;

  const Point3& point(VertexId v) const {
    return v < vertices.size() ? vertices[v] : seeds[v - static_cast<std::uint32_t>(vertices.size())];
  }
  int orient(VertexId a, VertexId b, VertexId c) const { return orient_along(axis, point(a), point(b), point(c)); }
  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return incircle_perturbed(flat(a), flat(b), flat(c), above(a), flat(d), {a, b, c, d});
  }

 private:
  // In the plane z = 0, keeping the orientation.
  Point3 flat(VertexId v) const {
    const auto p = as_array(point(v));
    return {p[(axis + 1) % 3], p[(axis + 2) % 3], 0};
  }
  Point3 above(VertexId v) const {
    Point3 p = flat(v);
    p.z = DyadicGrid::quantum;
    return p;
  }
};

}  // namespace ccdt::plc
