#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bench/experiments/small_plcs/small_plc.h"

/// Bravais lattices, and the Delaunay tetrahedralizations of their points, exactly.
///
/// A *lattice vector* is given by its whole coordinates in the basis, so volumes are determinants of small whole
/// numbers, in units of six times the smallest unit cell. Lengths come from the *Gram matrix*, the inner products of
/// the basis, which are whole numbers as well. So cospherical points are found as such. A *Delaunay polytope* is the
/// convex hull of all lattice points on an empty sphere: a tetrahedron, or one that can be divided into tetrahedra in
/// several ways.
namespace ccdt::bravais {

using small_plcs::Point;

/// The inner products of the basis a, b, c, in any unit. No product overflows up to `largest_entry`.
struct Gram {
  std::int64_t aa = 1, bb = 1, cc = 1, ab = 0, ac = 0, bc = 0;
};
inline constexpr std::int64_t largest_entry = 10000;

std::int64_t product(const Gram& gram, const Point& u, const Point& v);
inline std::int64_t squared_length(const Gram& gram, const Point& v) {
  return product(gram, v, v);
}

/// The squared volume of the unit cell that the basis spans.
std::int64_t squared_volume(const Gram& gram);
bool is_positive_definite(const Gram& gram);

/// The inner products of other vectors.
Gram of_vectors(const Gram& gram, const std::array<Point, 3>& vectors);

/// The vertices of a Delaunay polytope in lexicographic order, moved so that the first is the origin.
using Polytope = std::vector<Point>;

/// A lattice in a reduced basis, and its Delaunay polytopes. Of polytopes that are equal up to translation, it has one.
struct LatticeCells {
  Gram gram;
  std::vector<Polytope> polytopes = {};
};

/// A basis of the same lattice, whose vectors and their negative sum have no acute angles (Selling's reduction).
/// \pre `gram` is positive definite
Gram reduced(const Gram& gram);

/// The inner products of those four vectors, with opposite signs: 01, 02, 03, 12, 13, 23. None is negative.
std::array<std::int64_t, 6> selling_parameters(const Gram& gram);

/// The shortest vectors of each class modulo twice the lattice, except 0. Two lattice points belong to one Delaunay
/// polytope only if their difference is such a vector, and a sphere through the origin is empty if none of these is in
/// it, because they include all neighbors in the Voronoi diagram (Voronoi 1908; Conway and Sloane 1992).
/// \pre the basis is reduced
std::vector<Point> neighbors_of_origin(const Gram& gram);

/// \pre `gram` is positive definite
LatticeCells delaunay_polytopes(const Gram& gram);

/// Six times the volume, from its facets; 6 is that of the smallest unit cell.
/// \pre its facets have three or four vertices
std::int64_t six_volumes(const Polytope& polytope);

}  // namespace ccdt::bravais
