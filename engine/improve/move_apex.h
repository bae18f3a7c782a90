#pragma once

#include <span>

#include "engine/base/point.h"
#include "engine/improve/cell_quality.h"

namespace ccdt {

/// A face that the apex of a star sees: the tetrahedron a b c apex is positive.
struct StarFace {
  Point3 a, b, c;
};

/// Where a vertex may go: to any point with integer coordinates, or to those that are exactly on its facet or segment.
struct Freedom {
  int dimensions = 3;  ///< 0: nowhere; 1: its place + i u; 2: its place + i u + j v, with integers i and j; 3: anywhere
  Point3 u = {}, v = {};  ///< steps of integer coordinates
};

/// The worth of the worst tetrahedron of a star.
double worst_of_star(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex);

/// Moves the apex of a star to where the worst of its tetrahedra is better: to the mean of the star's vertices where
/// that makes all good enough, else by ascent on the non-smooth minimum of their worths (Freitag and Ollivier-Gooch
/// 1997), in steps that take the values of nearby functions into account as well as their gradients
/// (proximal_step.h). The new place has integer coordinates, and all tetrahedra are exactly positive there. For a gain
/// of a few per cent no more of them may be below the goal than before.
///
/// \param faces  in grid units
/// \param worst  `worst_of_star` at the apex
/// \return       `worst_of_star` at the new apex: greater, or equal where the apex has stayed
double move_apex(std::span<const StarFace> faces, const QualityGoal& goal, const Freedom& freedom, double worst,
                 Point3& apex);

}  // namespace ccdt
