#pragma once

#include <boost/rational.hpp>
#include <cstdint>
#include <utility>

#include "bench/experiments/bravais/lattice_cells.h"
#include "bench/experiments/bravais/triangulations.h"

namespace ccdt::bravais {

/// The tetrahedra of one period of a Delaunay tetrahedralization of a lattice. Together they have the volume of the
/// smallest unit cell.
struct UnitCell {
  Gram gram;
  Triangulation cells;
};

/// Which triangulation a Delaunay polytope gets if it is not a tetrahedron. The best minimizes the greatest r (then the
/// mean r); the worst maximizes it.
///
/// Polytopes choose alone, because neighbors always fit: octahedra have triangles for faces; pyramids meet at their
/// bases, and prisms at their rectangles, with their images by point reflection, which have the same diagonals; boxes
/// can be divided like mirror images, with a period of two boxes.
enum class Choice { best, worst };

/// \pre `gram` is positive definite
UnitCell unit_cell(const Gram& gram, Choice choice, KnownTriangulations& known);

using Fraction = boost::rational<std::int64_t>;

/// The square of the paper's measure r, exactly: (sum of squared edges)^3 / (432 (6 V)^2), with the volume V. 1 for the
/// regular tetrahedron.
Fraction squared_r(const Gram& gram, const Cell& cell);

/// The greatest and the mean r of the tetrahedra, by which unit cells are compared; less is better.
std::pair<double, double> worst_and_mean_r(const UnitCell& unit_cell);

/// The quality of the tetrahedra of one period. Angles in degrees.
struct UnitCellQuality {
  std::size_t cells = 0, regular = 0;
  Fraction best_squared_r = 0, worst_squared_r = 0;
  double best_r = 0, worst_r = 0;
  double mean_r = 0, mean_r_by_volume = 0;  ///< each tetrahedron counts as one, or by its volume
  double smallest_dihedral = 0, largest_dihedral = 0;
  double worst_aspect = 0, worst_radius_edge = 0;  ///< see bench/run/quality.h
};

UnitCellQuality quality_of(const UnitCell& unit_cell);

}  // namespace ccdt::bravais
