#pragma once

#include "engine/base/point.h"

/// Exact signs by CGAL's filtered kernel. They are the only predicates of the verification, so that an error in those
/// of the engine cannot hide itself. One translation unit holds CGAL, because it is slow to compile.
namespace ccdt::verify {

/// +1 when ((b-a) x (c-a)) . (d-a) > 0, 0 when the four points are coplanar, else -1.
int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// For a positively oriented abcd: +1 when e is strictly inside its circumsphere, 0 on it, -1 outside.
int side_of_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e);

}  // namespace ccdt::verify
