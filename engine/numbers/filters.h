#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/base/point.h"

namespace ccdt::numbers {

/// The floating-point stage in front of the exact predicates, inline for the inner loops.
///
/// Differences of coordinates are exact (grid.h), so the error of a determinant is a small multiple of 2^-53 times a
/// product of the largest entries; and where the entries share enough trailing zero bits that every intermediate
/// result fits 53 bits, as among the points of a lattice, there is no error at all, and a zero is a zero.
enum class Sign : std::int8_t { minus = -1, zero = 0, plus = 1, unknown = 2 };

// Four lanes, which the compiler maps to the registers of the processor. Always inlined, so never passed as arguments.
using Lanes = double __attribute__((vector_size(32)));
using IntegerLanes = std::int64_t __attribute__((vector_size(32)));
#define CCDT_ALWAYS_INLINE inline __attribute__((always_inline))

// Compiles a function once for every x86-64 and once for processors with 256-bit lanes; the program picks when it
// starts. Signs are the same: neither version contracts to FMA. (The sanitizers' runtimes do not support this.)
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CCDT_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define CCDT_WIDE_LANES
#endif

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
/// `low_bits` are the `integer_bits` of all entries, or-ed.
CCDT_ALWAYS_INLINE bool few_bits(const IntegerLanes& low_bits, double largest, double limit) {
  if (largest >= 0x1p51) return false;
  const std::int64_t bits = (low_bits[0] | low_bits[1] | low_bits[2]) & ((std::int64_t{1} << 52) - 1);
  const int k = std::countr_zero(static_cast<std::uint64_t>(bits));
  return largest <= limit * static_cast<double>(std::uint64_t{1} << (k < 52 ? k : 52));
}

/// The low 52 bits of the integers in two's complement, for magnitudes below 2^51.
CCDT_ALWAYS_INLINE void integer_bits(const Lanes& a, IntegerLanes& result) {
  constexpr double magic = 0x1.8p52;
  result = reinterpret_cast<IntegerLanes>(a + magic);
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
  IntegerLanes bits = {}, row_bits;
  for (const Lanes& row : rows) {
    filter::integer_bits(row, row_bits);
    bits |= row_bits;
  }
  // Intermediate results are below 6 * largest^3 <= 2^53.
  if (filter::few_bits(bits, largest_magnitude(mx, my, mz), 114000.0))
    return det > 0 ? Sign::plus : det < 0 ? Sign::minus : Sign::zero;
  return Sign::unknown;
}

/// Sign of the insphere determinant (plus: e inside, for positively oriented abcd). The four lanes are a, b, c, d; with
/// `next` the following lane, minors are formed of neighboring lanes (ab, bc, cd, da) and of opposite ones (ac, bd, ca,
/// db).
///
/// \param a,b,c,d,e  x, y, z, and anything
CCDT_ALWAYS_INLINE Sign insphere_filter(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d,
                                        const Lanes& e) {
  const Lanes ra = a - e, rb = b - e, rc = c - e, rd = d - e;
  // Transpose: x of all four, y, z.
  const Lanes ab_low = __builtin_shufflevector(ra, rb, 0, 4, 2, 6),
              ab_high = __builtin_shufflevector(ra, rb, 1, 5, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(rc, rd, 0, 4, 2, 6),
              cd_high = __builtin_shufflevector(rc, rd, 1, 5, 3, 7);
  const Lanes x = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  const Lanes y = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  const Lanes z = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  using filter::next, filter::opposite;
  Lanes x1, y1, z1, x2, y2, z2;
  next(x, x1), next(y, y1), next(z, z1);
  opposite(x, x2), opposite(y, y2), opposite(z, z2);
  const Lanes neighboring = x * y1 - x1 * y, across = x * y2 - x2 * y;
  Lanes neighboring_next;
  next(neighboring, neighboring_next);
  const Lanes volume = z * neighboring_next - z1 * across + z2 * neighboring;  // abc, bcd, cda, dab
  Lanes volume_next;
  next(volume, volume_next);
  const Lanes lift = x * x + y * y + z * z;
  const Lanes terms = lift * volume_next;
  const double det = (terms[0] - terms[1]) + (terms[2] - terms[3]);

  Lanes ma, mb, mc, md, m;
  filter::magnitude(ra, ma), filter::magnitude(rb, mb), filter::magnitude(rc, mc), filter::magnitude(rd, md);
  filter::maximum(ma, mb, ma), filter::maximum(mc, md, mc), filter::maximum(ma, mc, m);
  // 24 products of three entries, times a lift: with at most twelve roundings each, 288 * 2^-53, rounded up.
  constexpr double factor = 320 * 0x1p-53;
  const double bound = factor * (m[0] * m[1] * m[2]) * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
  if (std::fabs(det) > bound) return det > 0 ? Sign::plus : Sign::minus;
  IntegerLanes bits_a, bits_b, bits_c, bits_d;
  filter::integer_bits(ra, bits_a), filter::integer_bits(rb, bits_b);
  filter::integer_bits(rc, bits_c), filter::integer_bits(rd, bits_d);
  const IntegerLanes bits = (bits_a | bits_b) | (bits_c | bits_d);
  // Intermediate results are below 72 * largest^5 <= 2^53.
  if (filter::few_bits(bits, filter::larger(m[0], filter::larger(m[1], m[2])), 650.0))
    return det > 0 ? Sign::plus : det < 0 ? Sign::minus : Sign::zero;
  return Sign::unknown;
}

CCDT_ALWAYS_INLINE Sign insphere_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d,
                                        const Point3& e) {
  Lanes la, lb, lc, ld, le;
  filter::load(a, la), filter::load(b, lb), filter::load(c, lc), filter::load(d, ld), filter::load(e, le);
  return insphere_filter(la, lb, lc, ld, le);
}

/// Sign of the sum of angles that `incircle` (predicates.cpp) is about. The axis is the one nearest to the normal of
/// the plane.
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
  // Seven roundings in each product of a dot product, an area and the sum, rounded up for those of the bound.
  constexpr double factor = 16 * 0x1p-53;
  const double bound = factor * (product_c_size * area_d_size + area_c_size * product_d_size);
  if (std::fabs(area_c) <= factor * area_c_size) return Sign::unknown;
  if (std::fabs(det) > bound) return (det > 0) == (area_c > 0) ? Sign::minus : Sign::plus;
  return bound == 0 ? Sign::zero : Sign::unknown;  // without products there are no roundings
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

}  // namespace ccdt::numbers
