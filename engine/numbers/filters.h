#pragma once

#include <algorithm>
#include <cmath>

#include "engine/numbers/point.h"

namespace ccdt {

/// The floating-point filters in front of the exact predicates, inline for the inner loops.
///
/// They rely on exact differences of coordinates (grid.h): the determinants are evaluated with about ten roundings, so
/// that the error is a small multiple of 2^-53 times a product of the largest entries. A filter returns the determinant
/// when its sign is certain, else 0 (which says nothing).

/// ((b-a) x (c-a)) . (d-a), or 0 when its sign is not certain.
inline double orient3d_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
  const double det = dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
  // Six products of three entries, each with at most five roundings: 30 * 2^-53, rounded up for the bound's own
  // roundings.
  constexpr double factor = 40 * 0x1p-53;
  const double mx = std::max(std::max(std::fabs(bx), std::fabs(cx)), std::fabs(dx));
  const double my = std::max(std::max(std::fabs(by), std::fabs(cy)), std::fabs(dy));
  const double mz = std::max(std::max(std::fabs(bz), std::fabs(cz)), std::fabs(dz));
  const double bound = factor * mx * my * mz;
  return std::fabs(det) > bound ? det : 0.0;
}

/// The insphere determinant (positive: e inside, for positively oriented abcd), or 0 when its sign is not certain.
inline double insphere_filter(const Point3& a, const Point3& b, const Point3& c, const Point3& d, const Point3& e) {
  const double ax = a.x - e.x, ay = a.y - e.y, az = a.z - e.z;
  const double bx = b.x - e.x, by = b.y - e.y, bz = b.z - e.z;
  const double cx = c.x - e.x, cy = c.y - e.y, cz = c.z - e.z;
  const double dx = d.x - e.x, dy = d.y - e.y, dz = d.z - e.z;
  const double ab = ax * by - bx * ay, bc = bx * cy - cx * by;
  const double cd = cx * dy - dx * cy, da = dx * ay - ax * dy;
  const double ac = ax * cy - cx * ay, bd = bx * dy - dx * by;
  const double abc = az * bc - bz * ac + cz * ab;
  const double bcd = bz * cd - cz * bd + dz * bc;
  const double cda = cz * da + dz * ac + az * cd;
  const double dab = dz * ab + az * bd + bz * da;
  const double a2 = ax * ax + ay * ay + az * az, b2 = bx * bx + by * by + bz * bz;
  const double c2 = cx * cx + cy * cy + cz * cz, d2 = dx * dx + dy * dy + dz * dz;
  const double det = (c2 * dab - d2 * abc) + (a2 * bcd - b2 * cda);
  // 24 products of three entries, times a lift: with at most twelve roundings each, 288 * 2^-53, rounded up.
  constexpr double factor = 320 * 0x1p-53;
  const double mx = std::max(std::max(std::fabs(ax), std::fabs(bx)), std::max(std::fabs(cx), std::fabs(dx)));
  const double my = std::max(std::max(std::fabs(ay), std::fabs(by)), std::max(std::fabs(cy), std::fabs(dy)));
  const double mz = std::max(std::max(std::fabs(az), std::fabs(bz)), std::max(std::fabs(cz), std::fabs(dz)));
  const double m2 = std::max(std::max(a2, b2), std::max(c2, d2));
  const double bound = factor * mx * my * mz * m2;
  return std::fabs(det) > bound ? det : 0.0;
}

}  // namespace ccdt
