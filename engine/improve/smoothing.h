#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/tets/cell_quality.h"

namespace ccdt::improve {

using tets::QualityGoal;

/// A face as seen from the apex of a star: the tetrahedron a b c apex is positive.
struct StarFace {
  Point3 a, b, c;
};

/// Where a vertex may move: to any point with integer coordinates, or to those exactly on its facet or segment.
struct Freedom {
  /// 0: nowhere; 1: its position + i u; 2: its position + i u + j v, with integers i and j; 3: anywhere
  int dimensions = 3;
  Point3 u = {}, v = {};  ///< steps of integer coordinates
};

/// The quality of the worst tetrahedron of a star.
double worst_of_star(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex);

/// Coordinates in one array for each axis.
struct Coordinates {
  std::vector<double> x, y, z;

  void resize(std::size_t size) { x.resize(size), y.resize(size), z.resize(size); }
  Point3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Point3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
};

/// The faces of a star, prepared for computation: relative to the old apex, in units of the edge length, with
/// everything that does not depend on the apex. Reuse the object: it keeps its memory.
struct ScaledStar {
  double scale = 1;  ///< grid units in one unit
  Point3 mean = {};  ///< of the corners of the faces
  Coordinates a, b, c;
  Coordinates normal;          ///< (b - a) x (c - a)
  Coordinates centroid;        ///< of a face
  std::vector<double> height;  ///< normal . a
  /// Mean squared length of the six edges of the tetrahedron, without the part that depends on the apex.
  std::vector<double> mean_square;
  std::vector<double> inverse_area;     ///< 1 / normal^2
  std::vector<double> inverse_r, sine;  ///< of the tetrahedra, for the last computed apex

  std::size_t size() const { return height.size(); }
};

/// Functions of the apex's position near a point, each given by its value and gradient there.
struct LinearModels {
  std::vector<double> value;
  Coordinates gradient;

  std::size_t size() const { return value.size(); }
  void clear();
  void add(double v, const Point3& g);
};

/// \param faces  in grid units, at least one
void load_star(std::span<const StarFace> faces, const Point3& apex, ScaledStar& star);

/// The quality of the worst tetrahedron with the apex at `x`; see `cell_quality`. Leaves `inverse_r` and `sine` for `x`
/// in the star, where they matter.
double least_quality(const QualityGoal& goal, const Point3& x, ScaledStar& star);

/// Models the functions whose least value is the quality of the star: each tetrahedron's 1 / r as long as one of them
/// is below the goal, otherwise the sines of all dihedral angles. Where angles decide, a 1 / r that has reached its
/// goal must not drop below it again: its surplus, on top of the star's quality, is another function.
///
/// \param least   `least_quality` at `x`, which must have been the last call for this star
/// \param models  of those functions that are less than the star's quality + `reach`, in undefined order
void model_star(const QualityGoal& goal, const Point3& x, double least, double reach, const ScaledStar& star,
                LinearModels& models);

/// A step and its predicted result.
struct ProximalStep {
  Point3 step = {};
  double least = 0;  ///< least value of the models after the step
};

/// The step s that maximizes the least of the models minus s^2 / (2 `length`): a proximal point. The step is `length`
/// times a convex combination of gradients, which solves the dual problem. If only models of equal value matter, it is
/// their combination of least norm, the direction of steepest ascent.
///
/// \param models  at least one
ProximalStep proximal_step(const LinearModels& models, double length);

/// Working memory of `move_apex`.
struct MoveScratch {
  ScaledStar star;
  LinearModels models;
};

/// Moves the apex of a star to a position where the worst of its tetrahedra is better: to the mean of the star's
/// vertices if that makes all good enough, otherwise by ascent on the non-smooth minimum of their qualities (Freitag
/// and Ollivier-Gooch 1997). Its steps consider both the values and the gradients of nearby functions
/// (`proximal_step`). The new place has integer coordinates, and all tetrahedra are exactly positive there. For a gain
/// of a few percent, no more of them may be below the goal than before.
///
/// \param faces  in grid units
/// \param worst  `worst_of_star` at the apex
/// \return       `worst_of_star` at the new apex: greater, or equal if the apex stays
double move_apex(std::span<const StarFace> faces, const QualityGoal& goal, const Freedom& freedom, double worst,
                 MoveScratch& scratch, Point3& apex);

}  // namespace ccdt::improve
