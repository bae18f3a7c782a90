#include "bench/verify/exact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>

namespace ccdt::verify {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 to_cgal(const Point3& p) {
  return {p.x, p.y, p.z};
}

Kernel::Triangle_3 to_cgal(const std::array<Point3, 3>& t) {
  return {to_cgal(t[0]), to_cgal(t[1]), to_cgal(t[2])};
}

}  // namespace

bool are_on_one_line(const Point3& a, const Point3& b, const Point3& c) {
  return CGAL::collinear(to_cgal(a), to_cgal(b), to_cgal(c));
}

int orientation(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return CGAL::orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d));
}

int side_of_sphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  return CGAL::side_of_oriented_sphere(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d), to_cgal(e));
}

bool are_on_one_side(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return CGAL::coplanar_orientation(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d)) == CGAL::POSITIVE;
}

bool do_meet(const std::array<Point3, 3>& triangle, const std::array<Point3, 3>& other) {
  return CGAL::do_intersect(to_cgal(triangle), to_cgal(other));
}

bool do_meet(const std::array<Point3, 2>& segment, const std::array<Point3, 3>& triangle) {
  return CGAL::do_intersect(Kernel::Segment_3(to_cgal(segment[0]), to_cgal(segment[1])), to_cgal(triangle));
}

}  // namespace ccdt::verify
