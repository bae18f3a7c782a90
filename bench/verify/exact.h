#pragma once

#include <array>

#include "engine/base/point.h"

/// Exact signs by CGAL's filtered kernel. The verification uses no other predicates, so that it does not repeat an
/// error of the engine.
namespace ccdt::verify {

/// Are the three points on one line (or equal)?
bool are_on_one_line(const Point3& a, const Point3& b, const Point3& c);

/// +1 when ((b-a) x (c-a)) . (d-a) > 0, 0 when the four points are coplanar, else -1.
int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// For a positively oriented abcd: +1 when e is strictly inside its circumsphere, 0 on it, -1 outside.
int side_of_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e);

/// Are c and d, which are in one plane with a and b, on the same side of the line ab?
bool are_on_one_side(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Which of two triangles does the segment pq cross first? -1: `a`, +1: `b`, 0: both in one point. The segment is not
/// in the plane of either.
int compare_along(const Point3& p, const Point3& q, const std::array<Point3, 3>& a, const std::array<Point3, 3>& b);

/// Do the two have a common point? Triangles and segments that are not degenerate.
bool do_meet(const std::array<Point3, 3>& triangle, const std::array<Point3, 3>& other);
bool do_meet(const std::array<Point3, 2>& segment, const std::array<Point3, 3>& triangle);

}  // namespace ccdt::verify
