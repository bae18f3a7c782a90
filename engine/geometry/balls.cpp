#include "engine/geometry/balls.h"

#include <cmath>

namespace ccdt {

Ball smallest_ball(const Point3& a, const Point3& b) {
  return {0.5 * (a + b), 0.5 * std::sqrt(squared_length(b - a)) * (1 + margin_of_balls)};
}

Ball smallest_ball(const std::array<Point3, 3>& triangle) {
  // a to b is the longest edge, c the corner across.
  std::array<Point3, 3> t = triangle;
  for (int turn = 0; turn < 2; ++turn) {
    const double opposite_c = squared_length(t[1] - t[0]);
    if (opposite_c >= squared_length(t[2] - t[1]) && opposite_c >= squared_length(t[0] - t[2])) break;
    t = {t[1], t[2], t[0]};
  }
  const auto& [a, b, c] = t;
  const Point3 middle = 0.5 * (a + b), along = b - a, to_c = c - middle;
  const double radius2 = 0.25 * squared_length(along), excess = squared_length(to_c) - radius2;
  const Point3 height = to_c - (dot(to_c, along) / squared_length(along)) * along;
  const double height2 = squared_length(height);
  if (excess <= 0 || height2 == 0) return smallest_ball(a, b);
  // The center is on the line from the middle of ab toward c, where a and c are equally far.
  const double shift = excess / (2 * height2);
  const double radius = std::sqrt(radius2 + shift * shift * height2);
  constexpr double rounding = 1e-15;
  return {middle + shift * height, radius * (1 + margin_of_balls) + rounding * radius2 / std::sqrt(height2)};
}

}  // namespace ccdt
