#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

#include "engine/base/point.h"
#include "engine/geometry/integer_points.h"

namespace ccdt {

/// The exact points where edges and planes of triangles meet. All corners are multiples of the quantum, and integers
/// here are measured in quanta: coordinates have 33 bits, normals 68, and offsets of planes 101.
using Long = boost::multiprecision::int256_t;
using VeryLong = boost::multiprecision::int512_t;

/// A point with rational coordinates: numerator[i] / denominator. These have at most 238 and 208 bits, where three
/// planes meet. The fractions need not be reduced.
struct ExactPoint {
  std::array<Long, 3> numerator;
  Long denominator = 1;  ///< positive
};

/// A plane: the points p with normal * p = offset.
struct ExactPlane {
  WideVector normal;
  Wide offset = 0;
};

ExactPlane plane_of(const std::array<Point3, 3>& triangle);

/// A vertex.
ExactPoint exactly(const Point3& vertex);

/// The point where the edge from p to q meets a plane. The edge's ends are on different sides of the plane.
ExactPoint meet_plane(const Point3& p, const Point3& q, const ExactPlane& plane);

/// The point where the edge from p to q meets the line through a and b. Both are in one plane, and the edge's ends are
/// on different sides of the line.
///
/// \param axis  not parallel to that plane
ExactPoint meet_line(int axis, const Point3& p, const Point3& q, const Point3& a, const Point3& b);

/// The only point that three planes have in common.
ExactPoint meet_planes(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c);

/// The side of the plane that the point is on: that of the normal (1), in it (0) or the other (-1).
int side_of_plane(const ExactPlane& plane, const ExactPoint& p);

/// The side of the line from a to b that the point is on, seen along the axis; as in `orient_along`.
int side_of_line(int axis, const Point3& a, const Point3& b, const ExactPoint& p);

/// The sign of the difference of p and q along an axis.
int compare_along(int axis, const ExactPoint& p, const ExactPoint& q);

bool are_equal(const ExactPoint& p, const ExactPoint& q);

/// The nearest multiple of the quantum, in grid units. Equal points become equal, whatever they were found from.
Point3 rounded(const ExactPoint& p);

}  // namespace ccdt
