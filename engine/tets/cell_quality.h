#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "engine/base/point.h"
#include "engine/delaunay/delaunay.h"
#include "engine/tets/objective.h"

namespace ccdt::tets {

/// The goals, as numbers to compare with 1 / r and the least sine.
struct QualityGoal {
  Objective objective = Objective::r;
  double inverse_r = 0.5;
  double sine = 0.34;

  bool is_of_r() const { return objective == Objective::r; }
  /// What is added to sines: for `Objective::r`, it puts them above all values of 1 / r that have not reached the goal.
  double offset() const { return is_of_r() ? 1 : 0; }
  /// The quality to reach first.
  double first() const { return is_of_r() ? inverse_r : sine; }
  /// A tetrahedron of at least this quality is good enough.
  double good() const { return offset() + sine; }
};

/// 1 / r of a tetrahedron with this determinant and mean squared edge length.
inline double inverse_r_of(double det, double mean) {
  return std::numbers::sqrt2 * det / (mean * std::sqrt(mean));
}

/// 1 / r = sqrt(2) det / m^(3/2), where det is six times the volume and m is the mean squared length of the six edges.
/// The apex d is above abc in a positive tetrahedron.
double inverse_r(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The sine of the dihedral angle at an edge of length l between faces of areas A and B in a tetrahedron of volume V is
/// 3 V l / (2 A B).
double least_sine(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The quality of a tetrahedron by the objective: greater is better, and 0 or less means flat or inverted. The quality
/// of a set of tetrahedra is that of its worst.
///
/// For `Objective::r` it is 1 / r up to the goal; from there on, it is 1 plus the least sine of the dihedral angles: r
/// comes first, and angles decide where r is good.
double cell_quality(const QualityGoal& goal, const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The qualities of many cells, bit for bit those of `cell_quality`.
void compute_qualities(const QualityGoal& goal, std::span<const Point3> points, std::span<const delaunay::Cell> cells,
                       std::span<double> qualities);

}  // namespace ccdt::tets
