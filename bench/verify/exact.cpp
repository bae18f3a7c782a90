#include "bench/verify/exact.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Segment_3.h>
#include <CGAL/Simple_cartesian.h>
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

using Rational = CGAL::Exact_rational;
using RationalKernel = CGAL::Simple_cartesian<Rational>;

RationalKernel::Point_3 to_rational(const Point3& p) {
  return {p.x, p.y, p.z};
}

/// Where the segment pq crosses the plane of a triangle: 0 at p, 1 at q.
Rational find_crossing(const Point3& p, const Point3& q, const std::array<Point3, 3>& triangle) {
  const auto a = to_rational(triangle[0]), from = to_rational(p), to = to_rational(q);
  const auto normal = CGAL::cross_product(to_rational(triangle[1]) - a, to_rational(triangle[2]) - a);
  return (normal * (a - from)) / (normal * (to - from));
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

int compare_along(const Point3& p, const Point3& q, const std::array<Point3, 3>& a, const std::array<Point3, 3>& b) {
  return CGAL::compare(find_crossing(p, q, a), find_crossing(p, q, b));
}

bool do_meet(const std::array<Point3, 3>& triangle, const std::array<Point3, 3>& other) {
  return CGAL::do_intersect(to_cgal(triangle), to_cgal(other));
}

bool do_meet(const std::array<Point3, 2>& segment, const std::array<Point3, 3>& triangle) {
  return CGAL::do_intersect(Kernel::Segment_3(to_cgal(segment[0]), to_cgal(segment[1])), to_cgal(triangle));
}

}  // namespace ccdt::verify
