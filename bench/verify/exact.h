#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "engine/base/point.h"

/// Exact signs by CGAL's filtered kernel. They are the only predicates of the verification, so that an error in those
/// of the engine cannot hide itself.
namespace ccdt::verify {

inline CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 to_cgal(const Point3& p) {
  return {p.x, p.y, p.z};
}

/// Are the three points on one line (or equal)?
inline bool are_on_one_line(const Point3& a, const Point3& b, const Point3& c) {
  return CGAL::collinear(to_cgal(a), to_cgal(b), to_cgal(c));
}

/// +1 when ((b-a) x (c-a)) . (d-a) > 0, 0 when the four points are coplanar, else -1.
inline int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d));
}

/// For a positively oriented abcd: +1 when e is strictly inside its circumsphere, 0 on it, -1 outside.
inline int side_of_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  return CGAL::side_of_oriented_sphere(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d), to_cgal(e));
}

}  // namespace ccdt::verify
