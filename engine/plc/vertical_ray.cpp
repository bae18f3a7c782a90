#include "engine/plc/vertical_ray.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <limits>

#include "engine/plc/quanta.h"

namespace ccdt {

namespace {

using VeryWide = boost::multiprecision::int256_t;

Quanta six_times(const Point3& p) {
  const Quanta q = to_quanta(p);
  return {6 * q[0], 6 * q[1], 6 * q[2]};
}

Quanta sum(const Quanta& a, const Quanta& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

// On which side of the line pq, seen from above, is the point x after its infinitesimal move?
int side_of_moved(const Quanta& p, const Quanta& q, const Quanta& x) {
  const std::int64_t ux = q[0] - p[0], uy = q[1] - p[1];
  const int sign = sign_of(Wide(ux) * (x[1] - p[1]) - Wide(uy) * (x[0] - p[0]));
  if (sign != 0) return sign;
  if (uy != 0) return uy > 0 ? -1 : 1;
  return (ux > 0) - (ux < 0);
}

// A triangle over the start of the ray, with its height there as a fraction.
struct Crossing {
  std::uint32_t triangle;
  WideVector normal;  // turned upwards
  bool turned;
  VeryWide height;  // sixfold, times normal[2]
};

int compare_products(const VeryWide& a, const VeryWide& b, const VeryWide& c, const VeryWide& d) {
  const VeryWide left = a * b, right = c * d;
  return left < right ? -1 : left > right ? 1 : 0;
}

// Lower at the start of the ray or, where both are equal, after the move aside.
bool is_lower(const Crossing& a, const Crossing& b) {
  const VeryWide az = a.normal[2], bz = b.normal[2];
  int sign = compare_products(a.height, bz, b.height, az);
  for (int k = 0; k < 2 && sign == 0; ++k)  // the slopes in x and y are -normal[k] / normal[2]
    sign = -compare_products(a.normal[k], bz, b.normal[k], az);
  return sign < 0;
}

Box box_above(const RayStart& start, bool upwards) {
  const double scale = DyadicGrid::quantum / 6, slack = DyadicGrid::quantum;  // more than the rounding of this box
  const Point3 p = {scale * static_cast<double>(start.sixfold[0]), scale * static_cast<double>(start.sixfold[1]),
                    scale * static_cast<double>(start.sixfold[2])};
  const Point3 margin = {slack, slack, slack};
  Box box = {p - margin, p + margin};
  if (upwards) box.high.z = std::numeric_limits<double>::infinity();
  return box;
}

}  // namespace

RayStart RayStart::at(const Point3& p) {
  return {six_times(p)};
}

RayStart RayStart::middle_of(const Point3& a, const Point3& b) {
  const Quanta s = sum(to_quanta(a), to_quanta(b));
  return {{3 * s[0], 3 * s[1], 3 * s[2]}};
}

RayStart RayStart::centroid_of(const Point3& a, const Point3& b, const Point3& c) {
  const Quanta s = sum(sum(to_quanta(a), to_quanta(b)), to_quanta(c));
  return {{2 * s[0], 2 * s[1], 2 * s[2]}};
}

std::vector<RayHit> VerticalRays::shoot(const RayStart& start, std::optional<std::uint32_t> own) const {
  const Quanta& q = start.sixfold;
  std::vector<Crossing> crossings;
  tree_.for_each_meeting(box_above(start, true), [&](std::uint32_t t) {
    if (own && *own == t) return;
    const auto [va, vb, vc] = triangles_.corners[t];
    const Quanta a = six_times(vertices_[va]), b = six_times(vertices_[vb]), c = six_times(vertices_[vc]);
    const int side = side_of_moved(a, b, q);
    if (side_of_moved(b, c, q) != side || side_of_moved(c, a, q) != side) return;
    WideVector n = exact_normal(to_quanta(vertices_[va]), to_quanta(vertices_[vb]), to_quanta(vertices_[vc]));
    const bool turned = n[2] < 0;
    if (turned) n = {-n[0], -n[1], -n[2]};
    const Wide below = n[0] * (q[0] - a[0]) + n[1] * (q[1] - a[1]) + n[2] * (q[2] - a[2]);
    if (below > 0) return;  // zero is for the caller to exclude: the start is on the triangle then
    const Wide height = n[2] * a[2] - n[0] * (q[0] - a[0]) - n[1] * (q[1] - a[1]);
    crossings.push_back({t, n, turned, VeryWide(height)});
  });
  std::sort(crossings.begin(), crossings.end(), is_lower);
  std::vector<RayHit> hits;
  for (const Crossing& c : crossings) hits.push_back({c.triangle, c.turned});
  return hits;
}

bool VerticalRays::leaves_above(std::uint32_t triangle) const {
  const auto [a, b, c] = triangles_.corners[triangle];
  const WideVector n = exact_normal(to_quanta(vertices_[a]), to_quanta(vertices_[b]), to_quanta(vertices_[c]));
  if (n[2] != 0) return n[2] > 0;
  return n[0] != 0 ? n[0] > 0 : n[1] > 0;
}

std::optional<std::uint32_t> VerticalRays::triangle_at(const RayStart& start) const {
  const Quanta& q = start.sixfold;
  std::optional<std::uint32_t> found;
  tree_.for_each_meeting(box_above(start, false), [&](std::uint32_t t) {
    const auto [va, vb, vc] = triangles_.corners[t];
    const Quanta a = six_times(vertices_[va]), b = six_times(vertices_[vb]), c = six_times(vertices_[vc]);
    const WideVector n = exact_normal(to_quanta(vertices_[va]), to_quanta(vertices_[vb]), to_quanta(vertices_[vc]));
    if (n[0] * (q[0] - a[0]) + n[1] * (q[1] - a[1]) + n[2] * (q[2] - a[2]) != 0) return;
    const int axis = dominant_axis(rounded_normal(vertices_[va], vertices_[vb], vertices_[vc]));
    const int u = orient_along(axis, a, b, q), v = orient_along(axis, b, c, q), w = orient_along(axis, c, a, q);
    if ((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) found = found ? std::min(*found, t) : t;
  });
  return found;
}

}  // namespace ccdt
