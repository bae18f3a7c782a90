#include "engine/improve/cell_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ccdt::improve {

QualityGoal goal_of(const ImproveOptions& options) {
  return {options.objective, 1 / options.target_r, std::sin(options.target_dihedral * std::numbers::pi / 180)};
}

double inverse_r(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = a - d, v = b - d, w = c - d;
  const double det = dot(u, cross(w, v));
  const double mean =
      0.5 * (squared_length(u) + squared_length(v) + squared_length(w)) - (dot(u, v) + dot(v, w) + dot(w, u)) / 3;
  return std::numbers::sqrt2 * det / (mean * std::sqrt(mean));
}

double least_sine(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = a - d, v = b - d, w = c - d;
  const Point3 vw = cross(w, v), wu = cross(u, w), uv = cross(v, u);
  const double det = dot(u, vw);
  // Squares of twice the areas of the faces opposite to a, b, c, d, inverted.
  const double fa = 1 / squared_length(vw), fb = 1 / squared_length(wu), fc = 1 / squared_length(uv);
  const double fd = 1 / squared_length(vw + wu + uv);
  const double least =
      std::min({squared_length(u) * fb * fc, squared_length(v) * fa * fc, squared_length(w) * fa * fb,
                squared_length(v - u) * fc * fd, squared_length(w - v) * fa * fd, squared_length(u - w) * fb * fd});
  return det * std::sqrt(least);
}

double cell_quality(const QualityGoal& goal, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  if (goal.objective == Objective::dihedral) return least_sine(a, b, c, d);
  const double shape = inverse_r(a, b, c, d);
  return shape < goal.inverse_r ? shape : 1 + least_sine(a, b, c, d);
}

double goal_quality(const QualityGoal& goal) {
  return goal.objective == Objective::dihedral ? goal.sine : 1 + goal.sine;
}

}  // namespace ccdt::improve
