#include "bench/verify/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/verify/exact.h"

namespace ccdt::verification {

namespace {

enum class Crossing { no, up, down, grazes };

/// How the line through p and q crosses the triangle abc, and whether between p and q.
Crossing cross_triangle(const Point3& p, const Point3& q, const Point3& a, const Point3& b, const Point3& c) {
  const int ab = orientation(p, q, a, b), bc = orientation(p, q, b, c), ca = orientation(p, q, c, a);
  const int low = std::min({ab, bc, ca}), high = std::max({ab, bc, ca});
  if (low < 0 && high > 0) return Crossing::no;
  const int from = orientation(a, b, c, p), to = orientation(a, b, c, q);
  if (from * to > 0) return Crossing::no;
  if (from == 0 || to == 0 || low == 0 || high == 0) return Crossing::grazes;
  return from < 0 ? Crossing::up : Crossing::down;
}

/// A piece is the sum of the triangles of its directed edges with one of its vertices, as far as a ray can tell.
Crossing cross_piece(const Surface& surface, std::uint32_t piece, const Point3& p, const Point3& q) {
  const std::uint32_t origin = surface.directed[surface.piece_begin[piece]][0];
  int sum = 0;
  for (std::uint32_t i = surface.piece_begin[piece]; i < surface.piece_begin[piece + 1]; ++i) {
    const auto& [a, b] = surface.directed[i];
    if (a == origin || b == origin) continue;
    const Crossing crossing = cross_triangle(p, q, surface.at(origin), surface.at(a), surface.at(b));
    if (crossing == Crossing::grazes) return crossing;
    sum += crossing == Crossing::up ? 1 : crossing == Crossing::down ? -1 : 0;
  }
  return sum == 0 ? Crossing::no : sum > 0 ? Crossing::up : Crossing::down;
}

/// A number between -1 and 1 without a pattern that the input could share.
double scatter(int i) {
  const double x = std::sin(12.9898 * (i + 1)) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

}  // namespace

RayShooter::RayShooter(const Surface& surface) : surface_(surface) {
  rectangles_.reserve(surface.pieces());
  high_z_ = -std::numeric_limits<double>::infinity();
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const Point3& o = surface.origin(p);
    Rectangle r{o.x, o.y, o.x, o.y, o.z};
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) {
      const Point3& v = surface.at(surface.directed[i][0]);
      r = {std::min(r.low_x, v.x), std::min(r.low_y, v.y), std::max(r.high_x, v.x), std::max(r.high_y, v.y),
           std::max(r.high_z, v.z)};
    }
    high_z_ = std::max(high_z_, r.high_z);
    rectangles_.push_back(r);
  }
}

Point3 RayShooter::direction(int attempt) {
  return {0.05 * scatter(2 * attempt), 0.05 * scatter(2 * attempt + 1), 1};
}

std::optional<std::vector<Hit>> RayShooter::shoot(const Point3& start, int attempt) const {
  const Point3 end = start + length(start.z) * direction(attempt);
  const double low_x = std::min(start.x, end.x), high_x = std::max(start.x, end.x);
  const double low_y = std::min(start.y, end.y), high_y = std::max(start.y, end.y);
  std::vector<Hit> hits;
  for (std::uint32_t p = 0; p < surface_.pieces(); ++p) {
    const Rectangle& r = rectangles_[p];
    if (r.high_x < low_x || r.low_x > high_x || r.high_y < low_y || r.low_y > high_y || r.high_z < start.z) continue;
    const Crossing crossing = cross_piece(surface_, p, start, end);
    if (crossing == Crossing::no) continue;
    const Point3& n = surface_.area_vector[p];
    const double rise = dot(n, end - start);
    if (crossing == Crossing::grazes || rise == 0) return std::nullopt;
    hits.push_back({p, dot(n, surface_.origin(p) - start) / rise, crossing == Crossing::down});
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.along < b.along; });
  for (std::size_t i = 1; i < hits.size(); ++i)
    if (hits[i].along - hits[i - 1].along < 1e-12) return std::nullopt;
  return hits;
}

}  // namespace ccdt::verification
