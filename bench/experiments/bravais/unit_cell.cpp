#include "bench/experiments/bravais/unit_cell.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "bench/run/quality.h"
#include "engine/geometry/tetrahedron_shape.h"

namespace ccdt::bravais {
namespace {

/// The square of r as numerator and denominator.
std::pair<std::int64_t, std::int64_t> terms_of_squared_r(const Gram& gram, const Cell& cell) {
  std::int64_t edges = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) edges += squared_length(gram, cell[j] - cell[i]);
  const std::int64_t six_volumes = six_volumes_of(cell);
  return {edges * edges * edges, 432 * six_volumes * six_volumes * squared_volume(gram)};
}

double r_of(const Gram& gram, const Cell& cell) {
  const auto [numerator, denominator] = terms_of_squared_r(gram, cell);
  return std::sqrt(static_cast<double>(numerator) / static_cast<double>(denominator));
}

/// A basis with these inner products (Cholesky's decomposition).
std::array<Point3, 3> basis_of(const Gram& gram) {
  const auto at = [](std::int64_t entry) { return static_cast<double>(entry); };
  const double ax = std::sqrt(at(gram.aa)), bx = at(gram.ab) / ax, cx = at(gram.ac) / ax;
  const double by = std::sqrt(at(gram.bb) - bx * bx), cy = (at(gram.bc) - bx * cx) / by;
  return {{{ax, 0, 0}, {bx, by, 0}, {cx, cy, std::sqrt(at(gram.cc) - cx * cx - cy * cy)}}};
}

std::array<Point3, 4> coordinates_of(const std::array<Point3, 3>& basis, const Cell& cell) {
  std::array<Point3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = static_cast<double>(cell[i].x) * basis[0] + static_cast<double>(cell[i].y) * basis[1] +
                 static_cast<double>(cell[i].z) * basis[2];
  return corners;
}

}  // namespace

UnitCell unit_cell(const Gram& gram, Choice choice, KnownTriangulations& known) {
  const LatticeCells lattice = delaunay_polytopes(gram);
  UnitCell period{lattice.gram, {}};
  for (const Polytope& polytope : lattice.polytopes) {
    const auto rating = [&](const Triangulation& cells) { return worst_and_mean_r({lattice.gram, cells}); };
    const auto& all = known.of(polytope);
    const Triangulation& chosen = choice == Choice::best ? *std::ranges::min_element(all, {}, rating)
                                                         : *std::ranges::max_element(all, {}, rating);
    period.cells.insert(period.cells.end(), chosen.begin(), chosen.end());
  }
  return period;
}

std::pair<double, double> worst_and_mean_r(const UnitCell& unit_cell) {
  double worst = 0, sum = 0;
  for (const Cell& cell : unit_cell.cells) {
    const double r = r_of(unit_cell.gram, cell);
    worst = std::max(worst, r);
    sum += r;
  }
  return {worst, sum / static_cast<double>(unit_cell.cells.size())};
}

Fraction squared_r(const Gram& gram, const Cell& cell) {
  const auto [numerator, denominator] = terms_of_squared_r(gram, cell);
  return {numerator, denominator};
}

UnitCellQuality quality_of(const UnitCell& unit_cell) {
  UnitCellQuality quality{.cells = unit_cell.cells.size(), .smallest_dihedral = 180};
  const std::array<Point3, 3> basis = basis_of(unit_cell.gram);
  std::int64_t volume = 0;
  for (const Cell& cell : unit_cell.cells) {
    const Fraction squared = squared_r(unit_cell.gram, cell);
    const double r = r_of(unit_cell.gram, cell);
    if (quality.best_r == 0 || squared < quality.best_squared_r) quality.best_squared_r = squared, quality.best_r = r;
    if (squared > quality.worst_squared_r) quality.worst_squared_r = squared, quality.worst_r = r;
    quality.regular += squared == Fraction(1) ? 1 : 0;
    quality.mean_r += r / static_cast<double>(quality.cells);
    quality.mean_r_by_volume += r * static_cast<double>(six_volumes_of(cell));
    volume += six_volumes_of(cell);
    const std::array<Point3, 4> corners = coordinates_of(basis, cell);
    const std::array<double, 6> angles = dihedral_angles(corners);
    quality.smallest_dihedral = std::min(quality.smallest_dihedral, std::ranges::min(angles));
    quality.largest_dihedral = std::max(quality.largest_dihedral, std::ranges::max(angles));
    quality.worst_aspect = std::max(quality.worst_aspect, aspect_ratio(corners));
    quality.worst_radius_edge = std::max(quality.worst_radius_edge, radius_edge_ratio(corners));
  }
  quality.mean_r_by_volume /= static_cast<double>(volume);
  return quality;
}

}  // namespace ccdt::bravais
