#include "engine/planar/points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/geometry/predicates.h"

namespace ccdt::planar {

Points::Points(std::span<const Point2> points) {
  if (points.empty()) return;
  Point2 low = points[0], high = points[0];
  for (const Point2& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  int exponent = 0;  // the extent is at most 2^exponent
  std::frexp(std::max(high.x - low.x, high.y - low.y), &exponent);
  grid_.reserve(points.size());
  for (const Point2& p : points) {
    grid_.push_back(
        {std::llround(std::ldexp(p.x - low.x, 26 - exponent)), std::llround(std::ldexp(p.y - low.y, 26 - exponent))});
  }
}

int Points::orient(VertexId a, VertexId b, VertexId c) const {
  const GridPoint &p = grid_[a], &q = grid_[b], &r = grid_[c];
  // Coordinates have 26 bits, so products have 52 bits.
  return sign_of((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
}

int Points::incircle(VertexId a, VertexId b, VertexId c, VertexId d) const {
  const GridPoint& o = grid_[d];
  std::array<std::int64_t, 3> x, y, height;
  const std::array<VertexId, 3> others{a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = grid_[others[i]].x - o.x;
    y[i] = grid_[others[i]].y - o.y;
    height[i] = x[i] * x[i] + y[i] * y[i];
  }
  Int128 determinant = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += Int128{height[i]} * (x[j] * y[k] - x[k] * y[j]);
  }
  if (determinant != 0) return sign_of(determinant);

  // Raising the height of one vertex by a small amount changes the determinant by that amount times the area of the
  // other three. For d the sign is opposite, because the others are measured from it.
  std::array<std::pair<VertexId, int>, 4> changes{
      {{a, orient(b, c, d)}, {b, orient(c, a, d)}, {c, orient(a, b, d)}, {d, -orient(a, b, c)}}};
  std::sort(changes.begin(), changes.end());
  for (const auto& [id, change] : changes) {
    if (change != 0) return change;
  }
  return 0;
}

}  // namespace ccdt::planar
