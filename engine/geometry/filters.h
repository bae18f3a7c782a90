#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/base/platform.h"
#include "engine/base/point.h"

namespace ccdt {

/// The floating-point stage in front of the exact predicates, inline for the inner loops.
///
/// Differences of coordinates are exact (grid.h), so the error of a determinant is a small multiple of 2^-53 times a
/// product of the largest entries. If the entries share enough trailing zero bits that every intermediate result fits
/// in 53 bits, as for points of a lattice, there is no error at all, and a zero is exact.
enum class Sign : std::int8_t { minus = -1, zero = 0, plus = 1, unknown = 2 };

// Four lanes, which the compiler maps to the registers of the processor. Always inlined, so never passed as arguments.
using Lanes = double __attribute__((vector_size(32)));
using IntegerLanes = std::int64_t __attribute__((vector_size(32)));

namespace filter {

/// The larger of two magnitudes. (std::fmax is a function call, because of NaN.)
CCDT_ALWAYS_INLINE double larger(double a, double b) {
  return a > b ? a : b;
}

CCDT_ALWAYS_INLINE double largest_magnitude(double a, double b, double c) {
  return larger(larger(std::fabs(a), std::fabs(b)), std::fabs(c));
}

/// x, y, z and a zero.
CCDT_ALWAYS_INLINE void load(const Point3& p, Lanes& result) {
  result = Lanes{p.x, p.y, p.z, 0.0};
}

CCDT_ALWAYS_INLINE void maximum(const Lanes& a, const Lanes& b, Lanes& result) {
  result = a > b ? a : b;
}

CCDT_ALWAYS_INLINE void magnitude(const Lanes& a, Lanes& result) {
  result = reinterpret_cast<Lanes>(reinterpret_cast<IntegerLanes>(a) & std::int64_t{0x7FFFFFFFFFFFFFFF});
}

CCDT_ALWAYS_INLINE void next(const Lanes& v, Lanes& result) {
  result = __builtin_shufflevector(v, v, 1, 2, 3, 0);
}

CCDT_ALWAYS_INLINE void opposite(const Lanes& v, Lanes& result) {
  result = __builtin_shufflevector(v, v, 2, 3, 0, 1);
}

/// Are the entries, integers of magnitude up to `largest`, multiples of some 2^k with largest <= limit * 2^k?
/// `low_bits` are those of `add_integer_bits` of all entries.
CCDT_ALWAYS_INLINE bool few_bits(const IntegerLanes& low_bits, double largest, double limit) {
  if (largest >= 0x1p51) return false;
  const std::int64_t bits = (low_bits[0] | low_bits[1] | low_bits[2]) & ((std::int64_t{1} << 52) - 1);
  const int k = std::countr_zero(static_cast<std::uint64_t>(bits));
  return largest <= limit * static_cast<double>(std::uint64_t{1} << (k < 52 ? k : 52));
}

/// Adds the low 52 bits of integers in two's complement, for magnitudes below 2^51.
CCDT_ALWAYS_INLINE void add_integer_bits(const Lanes& a, IntegerLanes& bits) {
  constexpr double magic = 0x1.8p52;
  bits |= reinterpret_cast<IntegerLanes>(a + magic);
}

}  // namespace filter

/// The error of `orient3d`, relative to the product of the largest entries in x, y and z: six products of three
/// entries, each with at most five roundings, make 30 * 2^-53, rounded up for the bound's own roundings.
inline constexpr double orient3d_error = 40 * 0x1p-53;

/// Sign of ((b-a) x (c-a)) . (d-a).
CCDT_ALWAYS_INLINE Sign orient3d_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
  const double det = dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
  using filter::largest_magnitude;
  const double mx = largest_magnitude(bx, cx, dx), my = largest_magnitude(by, cy, dy),
               mz = largest_magnitude(bz, cz, dz);
  if (std::fabs(det) > orient3d_error * mx * my * mz) return det > 0 ? Sign::plus : Sign::minus;
  const Lanes rows[3] = {{bx, by, bz, 0}, {cx, cy, cz, 0}, {dx, dy, dz, 0}};
  IntegerLanes bits = {};
  for (const Lanes& row : rows) filter::add_integer_bits(row, bits);
  // Intermediate results are below 6 * largest^3 <= 2^53.
  if (filter::few_bits(bits, largest_magnitude(mx, my, mz), 114000.0))
    return det > 0 ? Sign::plus : det < 0 ? Sign::minus : Sign::zero;
  return Sign::unknown;
}

namespace filter {

/// The columns of the rows a, b, c and d.
CCDT_ALWAYS_INLINE void transpose(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d, Lanes& x, Lanes& y,
                                  Lanes& z) {
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  x = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  y = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  z = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
}

/// The 2 x 2 minors of two columns: of neighboring rows (ab, bc, cd, da), of those after them (bc, cd, da, ab), and of
/// opposite rows (ac, bd, ca, db).
struct Minors {
  Lanes neighboring, next, across;
};

CCDT_ALWAYS_INLINE void find_minors(const Lanes& u, const Lanes& v, Minors& result) {
  Lanes u1, v1, u2, v2;
  next(u, u1), next(v, v1), opposite(u, u2), opposite(v, v2);
  result.neighboring = u * v1 - u1 * v;
  result.across = u * v2 - u2 * v;
  next(result.neighboring, result.next);
}

/// The determinants of the rows abc, bcd, cda and dab of three columns: the two of the minors, and w.
CCDT_ALWAYS_INLINE void find_determinants(const Minors& minors, const Lanes& w, Lanes& result) {
  Lanes w1, w2;
  next(w, w1), opposite(w, w2);
  result = w * minors.next - w1 * minors.across + w2 * minors.neighboring;
}

CCDT_ALWAYS_INLINE void find_volumes(const Lanes& x, const Lanes& y, const Lanes& z, Lanes& result) {
  Minors xy;
  find_minors(x, y, xy);
  find_determinants(xy, z, result);
}

/// The lanes where the first condition holds, as bits 0 to 3, and where the second one holds, as bits 4 to 7.
CCDT_ALWAYS_INLINE unsigned lanes_of(const IntegerLanes& first, const IntegerLanes& second) {
  const IntegerLanes bits = (first & IntegerLanes{1, 2, 4, 8}) | (second & IntegerLanes{16, 32, 64, 128});
  return static_cast<unsigned>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

/// The largest magnitude in each column of four rows.
CCDT_ALWAYS_INLINE void largest_magnitudes(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d,
                                           Lanes& result) {
  Lanes ma, mb, mc, md;
  magnitude(a, ma), magnitude(b, mb), magnitude(c, mc), magnitude(d, md);
  maximum(ma, mb, ma), maximum(mc, md, mc), maximum(ma, mc, result);
}

CCDT_ALWAYS_INLINE double largest_of_three(const Lanes& magnitudes) {
  return larger(magnitudes[0], larger(magnitudes[1], magnitudes[2]));
}

}  // namespace filter

/// Faces of a tetrahedron as bits: bit i is the face opposite corner i.
struct FacesAround {
  unsigned beyond;   ///< the point is certainly on their outer side
  unsigned unknown;  ///< the point may be in their plane
};

/// Which sides of the faces of the positively oriented abcd a point e is on.
///
/// \param a,b,c,d,e  x, y, z, and anything
CCDT_ALWAYS_INLINE FacesAround faces_around_filter(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d,
                                                   const Lanes& e) {
  const Lanes ra = a - e, rb = b - e, rc = c - e, rd = d - e;
  Lanes x, y, z, volume, m;
  filter::transpose(rb, rc, rd, ra, x, y, z);
  filter::find_volumes(x, y, z, volume);  // bcd, cda, dab, abc: those of the faces opposite a, b, c and d
  filter::largest_magnitudes(ra, rb, rc, rd, m);
  const Lanes outward = volume * Lanes{-1, 1, -1, 1}, bound = Lanes{} + orient3d_error * (m[0] * m[1] * m[2]);
  const unsigned certain = filter::lanes_of(outward > bound, -outward > bound);
  return {certain & 15, ~(certain | certain >> 4) & 15};
}

/// The error of `insphere`, relative to the product of the largest entries in x, y, z and lift: 24 products of three
/// entries and a lift, each with at most twelve roundings, make 288 * 2^-53, rounded up for the bound's own roundings.
inline constexpr double insphere_error = 320 * 0x1p-53;

/// `insphere` has no error for integers up to this: all intermediate results are below 72 * largest^5 <= 2^53.
inline constexpr double insphere_exact = 650;

/// Sign of the insphere determinant (plus: e inside, for positively oriented abcd).
CCDT_ALWAYS_INLINE Sign insphere_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                                        const Point3& e) {
  Lanes ra, rb, rc, rd;
  filter::load(a - e, ra), filter::load(b - e, rb), filter::load(c - e, rc), filter::load(d - e, rd);
  Lanes x, y, z, volume, volume_next;
  filter::transpose(ra, rb, rc, rd, x, y, z);
  filter::find_volumes(x, y, z, volume);
  filter::next(volume, volume_next);
  const Lanes lift = x * x + y * y + z * z;
  const Lanes terms = lift * volume_next;
  const double det = (terms[0] - terms[1]) + (terms[2] - terms[3]);

  Lanes m;
  filter::largest_magnitudes(ra, rb, rc, rd, m);
  const double bound = insphere_error * (m[0] * m[1] * m[2]) * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  if (std::fabs(det) > bound) return det > 0 ? Sign::plus : Sign::minus;
  IntegerLanes bits = {};
  for (const Lanes* const row : {&ra, &rb, &rc, &rd}) filter::add_integer_bits(*row, bits);
  if (filter::few_bits(bits, filter::largest_of_three(m), insphere_exact))
    return det > 0 ? Sign::plus : det < 0 ? Sign::minus : Sign::zero;
  return Sign::unknown;
}

/// The circumspheres of a tetrahedron's neighbors as bits: bit i is that of the neighbor opposite corner i.
struct SpheresAround {
  unsigned inside;   ///< the point is certainly inside
  unsigned on;       ///< the point is exactly on the sphere
  unsigned unknown;  ///< the point may be on the sphere
};

/// Which circumspheres of the neighbors of the positively oriented abcd a point e is in. Each neighbor has three
/// corners of abcd and one more: oa is that of the neighbor opposite a.
///
/// The lifted corners of each face span a plane; e is in the sphere if the lifted fourth corner is on one side of it.
///
/// \param a,b,c,d,oa,ob,oc,od,e  x, y, z, and anything
/// \param wanted                 the neighbors to look at
CCDT_ALWAYS_INLINE SpheresAround spheres_around_filter(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d,
                                                       const Lanes& oa, const Lanes& ob, const Lanes& oc,
                                                       const Lanes& od, const Lanes& e, unsigned wanted) {
  const Lanes ra = a - e, rb = b - e, rc = c - e, rd = d - e;
  const Lanes sa = oa - e, sb = ob - e, sc = oc - e, sd = od - e;
  Lanes x, y, z, ox, oy, oz;
  filter::transpose(rb, rc, rd, ra, x, y, z);
  filter::transpose(sa, sb, sc, sd, ox, oy, oz);
  const Lanes lift = x * x + y * y + z * z, o_lift = ox * ox + oy * oy + oz * oz;
  filter::Minors xy, yz, zx;
  filter::find_minors(x, y, xy), filter::find_minors(y, z, yz), filter::find_minors(z, x, zx);
  Lanes volume, tilt_x, tilt_y, tilt_z;  // of the faces bcd, cda, dab, abc
  filter::find_determinants(xy, z, volume), filter::find_determinants(yz, lift, tilt_x);
  filter::find_determinants(zx, lift, tilt_y), filter::find_determinants(xy, lift, tilt_z);
  const Lanes det = ((ox * tilt_x + oy * tilt_y) + (oz * tilt_z - o_lift * volume)) * Lanes{1, -1, 1, -1};

  Lanes m, mx, my, mz;
  filter::largest_magnitudes(ra, rb, rc, rd, m);
  filter::magnitude(ox, mx), filter::magnitude(oy, my), filter::magnitude(oz, mz);
  filter::maximum(mx, Lanes{} + m[0], mx), filter::maximum(my, Lanes{} + m[1], my);
  filter::maximum(mz, Lanes{} + m[2], mz);
  const Lanes bound = insphere_error * (mx * my * mz) * (mx * mx + my * my + mz * mz);
  const unsigned certain = filter::lanes_of(det > bound, det < -bound);
  const unsigned unknown = wanted & ~(certain | certain >> 4);
  if (unknown == 0) return {certain & wanted, 0, 0};
  IntegerLanes bits = {};
  for (const Lanes* const row : {&ra, &rb, &rc, &rd, &sa, &sb, &sc, &sd}) filter::add_integer_bits(*row, bits);
  Lanes n;
  filter::largest_magnitudes(sa, sb, sc, sd, n);
  filter::maximum(m, n, m);
  if (!filter::few_bits(bits, filter::largest_of_three(m), insphere_exact)) return {certain & wanted, 0, unknown};
  const unsigned exact = filter::lanes_of(det > Lanes{}, det == Lanes{});
  return {exact & wanted, (exact >> 4) & wanted, 0};
}

/// Sign that decides `incircle`, by the sum of two angles (see predicates.cpp). The axis is the one nearest to the
/// normal of the plane.
CCDT_ALWAYS_INLINE Sign incircle_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = a - c, v = b - c, p = a - d, q = b - d, normal = cross(u, v);
  const double nx = std::fabs(normal.x), ny = std::fabs(normal.y), nz = std::fabs(normal.z);
  const auto area = [&](const Point3& s, const Point3& t, double& magnitude) {
    const auto [s1, s2, t1, t2] = nx > ny && nx > nz ? std::array{s.y, s.z, t.y, t.z}
                                  : ny > nz          ? std::array{s.z, s.x, t.z, t.x}
                                                     : std::array{s.x, s.y, t.x, t.y};
    magnitude = std::fabs(s1 * t2) + std::fabs(s2 * t1);
    return s1 * t2 - s2 * t1;
  };
  const auto product = [](const Point3& s, const Point3& t, double& magnitude) {
    magnitude = std::fabs(s.x * t.x) + std::fabs(s.y * t.y) + std::fabs(s.z * t.z);
    return dot(s, t);
  };
  double area_c_size, area_d_size, product_c_size, product_d_size;
  const double area_c = area(u, v, area_c_size), area_d = area(q, p, area_d_size);
  const double product_c = product(u, v, product_c_size), product_d = product(p, q, product_d_size);
  const double det = product_c * area_d + area_c * product_d;
  // Seven roundings in each product of a dot product and an area, with the sum; rounded up for the roundings of the
  // bound.
  constexpr double factor = 16 * 0x1p-53;
  const double bound = factor * (product_c_size * area_d_size + area_c_size * product_d_size);
  if (std::fabs(area_c) <= factor * area_c_size) return Sign::unknown;
  if (std::fabs(det) > bound) return (det > 0) == (area_c > 0) ? Sign::minus : Sign::plus;
  return bound == 0 ? Sign::zero : Sign::unknown;  // if all products are zero, there are no roundings
}

/// Sign of the sum of orient3d(p, q, r, x) over x = a, b, c: that of the centroid. Never `zero`.
inline Sign orient3d_centroid_filter(const Point3& p, const Point3& q, const Point3& r, const Point3& a,
                                     const Point3& b, const Point3& c) {
  const Point3 u = q - p, v = r - p, ap = a - p, bp = b - p, cp = c - p;
  const Point3 w = ap + bp + cp;
  const double det = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) + w.z * (u.x * v.y - u.y * v.x);
  // As for orient3d_filter, with two more roundings in each sum.
  constexpr double factor = 60 * 0x1p-53;
  const auto bound = [](double s, double t, double x, double y, double z) {
    return filter::larger(filter::larger(std::fabs(s), std::fabs(t)), std::fabs(x) + std::fabs(y) + std::fabs(z));
  };
  const double mx = bound(u.x, v.x, ap.x, bp.x, cp.x), my = bound(u.y, v.y, ap.y, bp.y, cp.y),
               mz = bound(u.z, v.z, ap.z, bp.z, cp.z);
  if (std::fabs(det) <= factor * mx * my * mz) return Sign::unknown;
  return det > 0 ? Sign::plus : Sign::minus;
}

}  // namespace ccdt
