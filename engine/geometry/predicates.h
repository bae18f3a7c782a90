#pragma once

#include <array>
#include <cstdint>

#include "engine/base/point.h"

namespace ccdt {

__extension__ typedef __int128 Int128;  // not a name of ISO C++: __extension__ silences pedantic compilers

template <class Number>
int sign_of(const Number& x) {
  return (x > 0) - (x < 0);
}

/// Exact signs of determinants of points on the dyadic grid (grid.h). A sign is -1, 0 or +1.
///
/// All coordinates must be integers whose differences are exact in a double (|coordinate| <= 2^51 + 2^20). The signs
/// are exact: floating-point filter, then 64/128-bit integers after the shared trailing zero bits are shifted out,
/// then wide integers.

/// Sign of the volume of the tetrahedron abcd: +1 when d is on the side of abc from which abc is seen counterclockwise,
/// that is, sign of ((b-a) x (c-a)) . (d-a).
int orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The same, after `orient3d_filter` failed.
int orient3d_exactly(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// For a positively oriented abcd: +1 when e is strictly inside the circumsphere of abcd, -1 outside, 0 on it.
/// (For a negatively oriented abcd the sign is reversed.)
int insphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e);

/// The same, after `insphere_filter` failed.
int insphere_exactly(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e);

/// `insphere` without ties: a zero is decided by symbolic perturbation of the lifted heights. The height of the vertex
/// with rank i is raised by epsilon_i, where the epsilon of a greater rank is infinitely larger than that of a smaller
/// one. The points do not move. The result depends only on points and ranks, so the Delaunay tetrahedralization is
/// unique. Zero only if all five points are coplanar.
///
/// Because of the raised heights, the cospherical vertex with the greatest rank is outside the sphere of the others.
///
/// \param ranks  of a, b, c, d, e; distinct
int insphere_perturbed(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e,
                       const std::array<std::uint32_t, 5>& ranks);

/// The same for five points with `insphere` zero.
int insphere_tie(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e,
                 const std::array<std::uint32_t, 5>& ranks);

/// For exactly coplanar points, abc not on one line: +1 when d is strictly inside the circumcircle of abc, -1 outside,
/// 0 on it.
int incircle(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Within a plane: for a, b, c, d exactly coplanar and `apex` off their plane with orient3d(a, b, c, apex) > 0: +1 when
/// d is inside the circumcircle of abc. Decided by the same perturbed heights as `insphere_perturbed` (the apex has
/// none), so that the constrained Delaunay triangulation of a facet agrees with the tetrahedralization. Never zero.
///
/// \param ranks  of a, b, c, d; distinct
int incircle_perturbed(const Point3& a, const Point3& b, const Point3& c, const Point3& apex, const Point3& d,
                       const std::array<std::uint32_t, 4>& ranks);

/// Sign of orient3d(p, q, r, x) for x the centroid of the triangle abc, moved within abc by an infinitesimal generic
/// amount: zero only when the plane of p, q, r contains all of a, b, c or p, q, r are collinear.
int orient3d_centroid(const Point3& p, const Point3& q, const Point3& r, const Point3& a, const Point3& b,
                      const Point3& c);

/// Exact: are the three points on one line (or equal)?
bool collinear(const Point3& a, const Point3& b, const Point3& c);

}  // namespace ccdt
