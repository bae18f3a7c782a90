#pragma once

#include <array>
#include <cstdint>

#include "engine/base/point.h"

/// Computes the signs of engine/geometry/predicates.h in another way: with CGAL's exact kernel, and as determinants in
/// GMP's integers, where each infinitesimal is an actual tiny number.
namespace ccdt::test::reference {

int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d);
int insphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e);
bool collinear(const Point3& a, const Point3& b, const Point3& c);

/// The sign of the coefficient that the height of point i has in the insphere determinant.
int height_coefficient(const std::array<Point3, 5>& points, std::size_t i);

/// The insphere determinant with epsilon^(1 + k) added to the height of each point, where k of the others have a
/// greater rank and epsilon = 2^-200.
int insphere_with_epsilon(const std::array<Point3, 5>& points, const std::array<std::uint32_t, 5>& ranks);

/// The same within the plane of four points: the in-circle determinant of two coordinates and the height, for d, in
/// the orientation in which abc is counterclockwise.
int incircle_with_epsilon(const std::array<Point3, 4>& points, const std::array<std::uint32_t, 4>& ranks);

/// Side of the plane of p, q, r of the point with the weights 1 - epsilon - epsilon^2, 1 + epsilon, 1 + epsilon^2 of a,
/// b, c.
int orient3d_centroid_with_epsilon(const Point3& p, const Point3& q, const Point3& r, const Point3& a, const Point3& b,
                                   const Point3& c);

}  // namespace ccdt::test::reference
