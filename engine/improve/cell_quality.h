#pragma once

#include <array>

#include "engine/base/point.h"
#include "engine/improve/options.h"

namespace ccdt {

/// What improvement knows of a tetrahedron's shape. Both are 1 or less, and not positive if it is flat or inverted.
struct Shape {
  double inverse_r = 0;   ///< 1 / r of the paper (section 5), with the sign of the volume; 1: regular
  double least_sine = 0;  ///< of the six dihedral angles, with the sign of the volume
};

/// What is good enough, as numbers that can be compared with a `Shape`.
struct QualityGoal {
  Objective objective = Objective::r;
  double inverse_r = 0.5;
  double sine = 0.34;
};

QualityGoal goal_of(const ImproveOptions& options);

/// 1 / r = sqrt(2) det / m^(3/2), where det is six times the volume and m the mean square of the six edges. The apex d
/// is above abc in a positive tetrahedron.
double inverse_r(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// Of the dihedral angle at an edge of length l between faces of areas A and B in a tetrahedron of volume V, the sine
/// is 3 V l / (2 A B).
double least_sine(const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The worth of a tetrahedron to the objective: greater is better, and 0 or less is flat or inverted. A set of
/// tetrahedra is worth as much as its worst.
///
/// For `Objective::r` it is 1 / r up to the goal. Tetrahedra beyond that are all worth 1 and the least sine of their
/// dihedral angles: r comes first, angles decide where r is good.
double worth(const QualityGoal& goal, const Point3& a, const Point3& b, const Point3& c, const Point3& d);

/// The worth from which a tetrahedron is good enough.
double worth_of_goal(const QualityGoal& goal);

}  // namespace ccdt
