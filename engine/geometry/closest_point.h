#pragma once

#include <algorithm>
#include <array>

#include "engine/base/point.h"

/// Nearest points, in floating point. Ends and corners may be the same point.
namespace ccdt {

/// The point of the line segment from a to b that is nearest to p.
inline Point3 closest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
  if (a == b) return a;
  const Point3 along = b - a;
  const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
  return a + t * along;
}

/// The weights of the corners of a triangle at its point that is nearest to p; they sum to one (Ericson, "Real-Time
/// Collision Detection", 5.1.5).
inline std::array<double, 3> closest_on_triangle(const Point3& p, const std::array<Point3, 3>& t) {
  const auto weights = [](double v, double w) { return std::array{1 - v - w, v, w}; };
  const Point3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return weights(0, 0);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return weights(1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return weights(d1 / (d1 - d3), 0);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return weights(0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return weights(0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return weights(1 - w, w);
  }
  const double sum = va + vb + vc;
  return weights(vb / sum, vc / sum);
}

/// The point with these weights. A coordinate that all three corners share stays exactly the same.
inline Point3 weighted_point(const std::array<double, 3>& weights, const std::array<Point3, 3>& t) {
  return t[0] + (weights[1] * (t[1] - t[0]) + weights[2] * (t[2] - t[0]));
}

/// The squared distance of p from a triangle, or from a segment or a point given as a degenerate triangle.
inline double squared_distance(const std::array<Point3, 3>& triangle, const Point3& p) {
  return squared_length(weighted_point(closest_on_triangle(p, triangle), triangle) - p);
}

}  // namespace ccdt
