#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bench/experiments/bravais/unit_cell.h"

namespace ccdt::bravais {

/// A free parameter of a lattice: a ratio of squared lengths, or an inner product over a squared length. The search
/// starts at all values from `low` to `high` in these steps, in sixths.
struct FreeParameter {
  std::string_view name;  ///< as in a formula: "(c/a)^2"
  int low, high, step = 1;
};

/// The values of the free parameters, as fractions of one denominator.
struct ParameterValues {
  std::vector<int> numerators = {};
  int denominator = 1;
};

/// One of the 14 kinds of lattices.
struct BravaisLattice {
  std::string_view name;    ///< "face-centered cubic"
  std::string_view symbol;  ///< Pearson's: "cF"
  std::vector<FreeParameter> parameters;
  /// The inner products of a basis of the smallest unit cell. For some values, they are not positive definite.
  Gram (*gram)(const ParameterValues&);
};

/// All lattices, from the cubic ones to the triclinic one. A lattice with free parameters includes those of higher
/// symmetry as special values: it has such a symmetry if certain equations between its parameters hold.
std::span<const BravaisLattice> bravais_lattices();

/// The values that minimize the greatest r of a tetrahedron, then the mean r. Each Delaunay polytope gets its best
/// triangulation. Tries all values on a coarse grid, then the best neighbor on finer and finer grids, down to 1/96.
///
/// If the body-centered cubic lattice is a special value, the search finds the global optimum. Proof: the four vectors
/// of Selling's reduction divide each lattice into six tetrahedra of equal volume. The sums of their squared edges are
/// 3 P plus the sum of two opposite parameters, where P is the sum of all six parameters. So the mean of these sums is
/// 10 P / 3. The greatest r, as well as the mean of the convex function r, is at least that of six equal tetrahedra.
/// The volume at a given P is a concave function of the parameters (to the power of 2/3), symmetric, and greatest where
/// all parameters are equal. There, all six tetrahedra are also equal, and the lattice is body-centered cubic.
ParameterValues best_parameters(const BravaisLattice& lattice, KnownTriangulations& known);

/// The symbol of the cubic lattice to which a lattice is similar; empty if it is none.
std::string_view cubic_symbol(const Gram& gram);

}  // namespace ccdt::bravais
