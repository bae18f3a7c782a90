#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/improve/cell_complex.h"
#include "engine/improve/star_functions.h"

namespace ccdt::improve {

/// The cells around a vertex, and the faces opposite to it, as it sees them.
struct VertexStar {
  std::vector<std::uint32_t> cells;
  std::vector<StarFace> faces;  ///< of each cell
};

/// All cells that are connected around the vertex; walls do not separate them.
void gather_cells(const CellComplex& complex, std::uint32_t vertex, CellMarks& marks,
                  std::vector<std::uint32_t>& cells);

void gather_star(const CellComplex& complex, std::uint32_t vertex, CellMarks& marks, VertexStar& star);

/// Where a vertex may go: to any point with integer coordinates, or to those that are exactly on its facet or segment.
struct Freedom {
  int dimensions = 3;  ///< 0: nowhere; 1: its place + i u; 2: its place + i u + j v, with integers i and j; 3: anywhere
  Point3 u = {}, v = {};  ///< steps of integer coordinates
};

/// The quality of the worst tetrahedron of a star.
double worst_of_star(std::span<const StarFace> faces, const QualityGoal& goal, const Point3& apex);

/// Working memory of `move_apex`.
struct MoveScratch {
  ScaledStar star;
  LinearModels models;
};

/// Moves the apex of a star to where the worst of its tetrahedra is better: to the mean of the star's vertices where
/// that makes all good enough, else by ascent on the non-smooth minimum of their qualities (Freitag and Ollivier-Gooch
/// 1997), in steps that take the values of nearby functions into account as well as their gradients (`proximal_step`).
/// The new place has integer coordinates, and all tetrahedra are exactly positive there. For a gain of a few per cent
/// no more of them may be below the goal than before.
///
/// \param faces  in grid units
/// \param worst  `worst_of_star` at the apex
/// \return       `worst_of_star` at the new apex: greater, or equal where the apex has stayed
double move_apex(std::span<const StarFace> faces, const QualityGoal& goal, const Freedom& freedom, double worst,
                 MoveScratch& scratch, Point3& apex);

}  // namespace ccdt::improve
