#include "bench/verify/exact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace ccdt::verify {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 to_cgal(const Point3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return static_cast<int>(CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)));
}

int side_of_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  return static_cast<int>(CGAL::side_of_oriented_sphere(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d), to_cgal(e)));
}

}  // namespace ccdt::verify
