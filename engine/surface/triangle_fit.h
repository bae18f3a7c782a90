#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/point.h"

namespace ccdt::surface {

/// What the quality of a triangle is measured by: its area over its squared edges, or its smallest angle.
enum class TriangleMeasure { area, angle };

/// How well shaped a triangle is, and how well it stands for the original surface at its corners.
struct TriangleFit {
  double quality;    ///< 1 for the equilateral triangle, 0 for a degenerate one
  double agreement;  ///< the smallest cosine between its normal and the original surface's at its corners
};

/// In radians.
inline double smallest_angle(const std::array<Point3, 3>& p) {
  std::array<double, 3> squares = {squared_length(p[1] - p[0]), squared_length(p[2] - p[1]),
                                   squared_length(p[0] - p[2])};
  std::sort(squares.begin(), squares.end());
  const double product = std::sqrt(squares[1] * squares[2]);
  return product > 0 ? std::acos(std::clamp((squares[1] + squares[2] - squares[0]) / (2 * product), -1.0, 1.0)) : 0;
}

inline TriangleFit fit_of(const std::array<Point3, 3>& p, const std::array<Point3, 3>& normals,
                          TriangleMeasure measure = TriangleMeasure::area) {
  constexpr double two_root_three = 3.4641016151377544;
  const Point3 area = area_vector(p);
  const double size = length(area);
  const double squares = squared_length(p[1] - p[0]) + squared_length(p[2] - p[1]) + squared_length(p[0] - p[2]);
  if (size == 0) return {0, -1};
  return {measure == TriangleMeasure::area ? two_root_three * size / squares : smallest_angle(p) / to_radians(60),
          std::min({dot(area, normals[0]), dot(area, normals[1]), dot(area, normals[2])}) / size};
}

/// The worst of several triangles.
struct WorstFit {
  TriangleFit worst = {1, 1};

  void add(const TriangleFit& fit) {
    worst.quality = std::min(worst.quality, fit.quality);
    worst.agreement = std::min(worst.agreement, fit.agreement);
  }
};

/// Do triangles of the fit `after` stand for the original surface as well as those of the fit `before`, or well enough?
inline bool may_stand_for(const TriangleFit& before, const TriangleFit& after) {
  constexpr double good_agreement = 0.65;  // 50 degrees: an equilateral triangle on a circle's hexagon has 40
  constexpr double least_agreement = 0.2;
  return after.agreement >= std::max(least_agreement, std::min(good_agreement, before.agreement));
}

/// May triangles of the fit `after` replace those of the fit `before`? They have to be good, or no worse; but they may
/// never be turned away from the original surface.
inline bool may_replace(const TriangleFit& before, const TriangleFit& after, double good_quality) {
  return after.quality >= std::min(good_quality, before.quality) && may_stand_for(before, after);
}

/// Is the worst triangle really better after a change? Gains of rounding would go on for ever.
inline bool is_better(const TriangleFit& before, const TriangleFit& after) {
  constexpr double least_gain = 0.005;
  return after.quality >= before.quality + least_gain && may_stand_for(before, after);
}

}  // namespace ccdt::surface
