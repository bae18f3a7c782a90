#pragma once

#include <cstdint>
#include <cstdlib>

#include "engine/base/point.h"
#include "engine/geometry/integer_points.h"
#include "engine/geometry/predicates.h"

namespace ccdt::facets {

/// The axis nearest to the normal of a facet: 1, 2 or 3; negative if the normal points against it.
///
/// The normal of a single face of a nearly flat facet may point anywhere: the face may be a needle.
using FacetAxis = std::int8_t;

/// \param normal  of the facet: the sum over its faces
inline FacetAxis axis_along(const Point3& normal) {
  const int axis = dominant_axis(normal);
  return static_cast<FacetAxis>(as_array(normal)[axis] < 0 ? -axis - 1 : axis + 1);
}

/// Does a triangle turn the same way as the facet, seen along its axis? Exact. Faces that are not upright fold over.
inline bool is_upright(const Point3& a, const Point3& b, const Point3& c, FacetAxis axis) {
  const double up = axis > 0 ? 1 : -1;
  const int number = std::abs(axis);
  const Point3 apex = a + Point3{number == 1 ? up : 0, number == 2 ? up : 0, number == 3 ? up : 0};
  return orient3d(a, b, c, apex) > 0;
}

}  // namespace ccdt::facets
