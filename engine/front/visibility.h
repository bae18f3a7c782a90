#pragma once

#include <array>

#include "engine/base/point.h"

namespace ccdt::front {

/// The corners of a triangle.
using Corners = std::array<const Point3*, 3>;

/// Does the triangle t hide the point p from the (generically moved) centroid of the triangle abc? Exact: touching is
/// not crossing.
bool hides(const Corners& t, const Point3& p, const Point3& a, const Point3& b, const Point3& c);

/// Does an edge of one triangle pass through the inside of the other? Exact: touching is not crossing.
bool cross_each_other(const Corners& s, const Corners& t);

}  // namespace ccdt::front
