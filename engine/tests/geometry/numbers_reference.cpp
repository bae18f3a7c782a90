#include "engine/tests/geometry/numbers_reference.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpz.h>
#include <CGAL/determinant.h>

#include <algorithm>

namespace ccdt::test::reference {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Integer = CGAL::Gmpz;

// Nonzero coefficients are integers below 2^170 in magnitude, so this epsilon is smaller than any of their quotients.
constexpr unsigned epsilon_bits = 200;

Kernel::Point_3 kernel_point(const Point3& p) {
  return {p.x, p.y, p.z};
}

Integer power_of_two(unsigned exponent) {
  Integer result = 1;
  mpz_mul_2exp(result.mpz(), result.mpz(), exponent);
  return result;
}

/// The heights of points, in units of epsilon^n.
template <std::size_t n>
std::array<Integer, n> raised_heights(const std::array<Point3, n>& points, const std::array<std::uint32_t, n>& ranks) {
  std::array<Integer, n> heights;
  for (std::size_t i = 0; i < n; ++i) {
    const Integer x(points[i].x), y(points[i].y), z(points[i].z);
    const auto greater =
        std::count_if(ranks.begin(), ranks.end(), [&](std::uint32_t other) { return other > ranks[i]; });
    heights[i] = (x * x + y * y + z * z) * power_of_two(n * epsilon_bits) +
                 power_of_two((n - 1 - static_cast<unsigned>(greater)) * epsilon_bits);
  }
  return heights;
}

}  // namespace

int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  return CGAL::orientation(kernel_point(a), kernel_point(b), kernel_point(c), kernel_point(d));
}

int insphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  return CGAL::side_of_oriented_sphere(kernel_point(a), kernel_point(b), kernel_point(c), kernel_point(d),
                                       kernel_point(e));
}

bool collinear(const Point3& a, const Point3& b, const Point3& c) {
  return CGAL::collinear(kernel_point(a), kernel_point(b), kernel_point(c));
}

// Minus the determinant of the rows (x, y, z, height, 1) is positive for e inside a positive abcd. It is expanded by
// its column of heights; the minor of the rows (x, y, z, 1) of four points is minus their orient3d.
int height_coefficient(const std::array<Point3, 5>& points, std::size_t i) {
  std::array<const Point3*, 4> others;
  for (std::size_t j = 0, k = 0; j < 5; ++j)
    if (j != i) others[k++] = &points[j];
  const int minor = -reference::orient3d(*others[0], *others[1], *others[2], *others[3]);
  return i % 2 == 0 ? minor : -minor;
}

int insphere_with_epsilon(const std::array<Point3, 5>& points, const std::array<std::uint32_t, 5>& ranks) {
  const auto h = raised_heights(points, ranks);
  const auto x = [&](int i) { return Integer(points[i].x); };
  const auto y = [&](int i) { return Integer(points[i].y); };
  const auto z = [&](int i) { return Integer(points[i].z); };
  const Integer one = 1;
  return -CGAL::sign(CGAL::determinant(x(0), y(0), z(0), h[0], one,  //
                                       x(1), y(1), z(1), h[1], one,  //
                                       x(2), y(2), z(2), h[2], one,  //
                                       x(3), y(3), z(3), h[3], one,  //
                                       x(4), y(4), z(4), h[4], one));
}

int incircle_with_epsilon(const std::array<Point3, 4>& points, const std::array<std::uint32_t, 4>& ranks) {
  const auto h = raised_heights(points, ranks);
  const Integer one = 1;
  // Along an axis that is not in the plane.
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Integer, 4> u, v;
    for (int i = 0; i < 4; ++i) {
      const auto p = as_array(points[i]);
      u[i] = Integer(p[(axis + 1) % 3]);
      v[i] = Integer(p[(axis + 2) % 3]);
    }
    const int turn = CGAL::sign(CGAL::determinant(u[0], v[0], one, u[1], v[1], one, u[2], v[2], one));
    if (turn == 0) continue;
    return turn * CGAL::sign(CGAL::determinant(u[0], v[0], h[0], one,  //
                                               u[1], v[1], h[1], one,  //
                                               u[2], v[2], h[2], one,  //
                                               u[3], v[3], h[3], one));
  }
  return 0;
}

int orient3d_centroid_with_epsilon(const Point3& p, const Point3& q, const Point3& r, const Point3& a, const Point3& b,
                                   const Point3& c) {
  const auto volume = [&](const Point3& s) {
    const Integer one = 1;
    return -CGAL::determinant(Integer(p.x), Integer(p.y), Integer(p.z), one,  //
                              Integer(q.x), Integer(q.y), Integer(q.z), one,  //
                              Integer(r.x), Integer(r.y), Integer(r.z), one,  //
                              Integer(s.x), Integer(s.y), Integer(s.z), one);
  };
  const Integer full = power_of_two(2 * epsilon_bits), less = power_of_two(epsilon_bits), least = 1;
  return CGAL::sign((full - less - least) * volume(a) + (full + less) * volume(b) + (full + least) * volume(c));
}

}  // namespace ccdt::test::reference
