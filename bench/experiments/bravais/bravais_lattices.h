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
  /// The inner products of a basis of the smallest unit cell. May not be positive definite.
  Gram (*gram)(const ParameterValues&);
};

/// From the cubic ones to the triclinic one. A lattice with free parameters includes those of higher symmetry as
/// special values, because which it is depends on equations between its parameters.
std::span<const BravaisLattice> bravais_lattices();

/// The values with the least greatest r of a tetrahedron, and of these the least mean; each Delaunay polytope gets its
/// best triangulation. All values on a coarse grid, then the best neighbor on finer and finer ones, down to 1/96.
///
/// What it finds is the optimum of all lattices where the body-centered cubic lattice is a special value. Proof:
/// divided as the four vectors of Selling's reduction say, each lattice has six tetrahedra of equal volume, and the
/// sums of their squared edges are 3 P plus the sum of two opposite parameters, with P the sum of all six. So their
/// mean is 10 P / 3, and r of the greatest, as well as the mean of the convex function r, is at least what six equal
/// tetrahedra would have. The volume at a given P is a concave function of the parameters (to the power of 2/3),
/// symmetric, and greatest where all are equal: there all six tetrahedra are equal as well, and the lattice is
/// body-centered cubic.
ParameterValues best_parameters(const BravaisLattice& lattice, KnownTriangulations& known);

/// The symbol of the cubic lattice to which a lattice is similar; empty if it is none.
std::string_view cubic_symbol(const Gram& gram);

}  // namespace ccdt::bravais
