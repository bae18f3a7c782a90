#include "bench/experiments/bravais/bravais_lattices.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace ccdt::bravais {
namespace {

/// \name Bases of the smallest unit cells, in halves of the vectors of the usual unit cell.
/// @{
using Basis = std::array<Point, 3>;
constexpr Basis primitive = {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
constexpr Basis body_centered = {{{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}};
constexpr Basis face_centered = {{{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}};
constexpr Basis base_centered = {{{1, 1, 0}, {-1, 1, 0}, {0, 0, 2}}};
/// @}

template <const Basis& basis>
Gram cubic(const ParameterValues& /*none*/) {
  return of_vectors({}, basis);
}

template <const Basis& basis>
Gram tetragonal(const ParameterValues& p) {
  return of_vectors({p.denominator, p.denominator, p.numerators[0]}, basis);
}

template <const Basis& basis>
Gram orthorhombic(const ParameterValues& p) {
  return of_vectors({p.denominator, p.numerators[0], p.numerators[1]}, basis);
}

Gram hexagonal(const ParameterValues& p) {
  return {2 * p.denominator, 2 * p.denominator, 2 * p.numerators[0], -p.denominator, 0, 0};
}

Gram rhombohedral(const ParameterValues& p) {
  const int d = p.denominator, cosine = p.numerators[0];
  return {d, d, d, cosine, cosine, cosine};
}

template <const Basis& basis>
Gram monoclinic(const ParameterValues& p) {
  return of_vectors({p.denominator, p.numerators[0], p.numerators[1], 0, p.numerators[2], 0}, basis);
}

Gram triclinic(const ParameterValues& p) {
  const auto& n = p.numerators;
  return {p.denominator, n[0], n[1], n[2], n[3], n[4]};
}

std::vector<BravaisLattice> all_lattices() {
  constexpr int sixths = 6;
  const FreeParameter height{"(c/a)^2", 2, 3 * sixths}, width{"(b/a)^2", 2, 3 * sixths};
  const std::vector<FreeParameter> oblique = {
      {"(b/a)^2", 3, 3 * sixths, 3}, {"(c/a)^2", 3, 3 * sixths, 3}, {"a.c/a^2", -2 * sixths, 0}};
  // The shortest vectors of a triclinic lattice are its basis.
  const std::vector<FreeParameter> skew = {{"(b/a)^2", sixths, 2 * sixths, 3},
                                           {"(c/a)^2", sixths, 2 * sixths, 3},
                                           {"a.b/a^2", -3, 3},
                                           {"a.c/a^2", -3, 3},
                                           {"b.c/a^2", -3, 3}};
  return {{"simple cubic", "cP", {}, cubic<primitive>},
          {"body-centered cubic", "cI", {}, cubic<body_centered>},
          {"face-centered cubic", "cF", {}, cubic<face_centered>},
          {"simple tetragonal", "tP", {height}, tetragonal<primitive>},
          {"body-centered tetragonal", "tI", {height}, tetragonal<body_centered>},
          {"simple orthorhombic", "oP", {width, height}, orthorhombic<primitive>},
          {"base-centered orthorhombic", "oC", {width, height}, orthorhombic<base_centered>},
          {"body-centered orthorhombic", "oI", {width, height}, orthorhombic<body_centered>},
          {"face-centered orthorhombic", "oF", {width, height}, orthorhombic<face_centered>},
          {"hexagonal", "hP", {height}, hexagonal},
          {"rhombohedral", "hR", {{"cos alpha", -2, 5}}, rhombohedral},
          {"simple monoclinic", "mP", oblique, monoclinic<primitive>},
          {"base-centered monoclinic", "mC", oblique, monoclinic<base_centered>},
          {"triclinic", "aP", skew, triclinic}};
}

/// The greatest and the mean r; less is better.
using Rating = std::pair<double, double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A search for the best values of the free parameters.
struct ParameterSearch {
  const BravaisLattice& lattice;
  KnownTriangulations& known;
  ParameterValues best;
  Rating rating = {infinity, infinity};

  /// Takes these values if they are better than the best so far.
  void try_values(const ParameterValues& values) {
    const Gram gram = lattice.gram(values);
    if (!is_positive_definite(gram)) return;
    const Rating other = worst_and_mean_r(unit_cell(gram, Choice::best, known));
    if (!(other < rating)) return;
    rating = other;
    best = values;
  }

  /// Tries all values that have a step from `low` to `high` in each parameter.
  void try_all(const ParameterValues& from, std::span<const FreeParameter> steps) {
    if (steps.empty()) return try_values(from);
    const std::size_t parameter = from.numerators.size() - steps.size();
    for (int step = steps.front().low; step <= steps.front().high; step += steps.front().step) {
      ParameterValues moved = from;
      moved.numerators[parameter] += step;
      try_all(moved, steps.subspan(1));
    }
  }
};

}  // namespace

std::span<const BravaisLattice> bravais_lattices() {
  static const std::vector<BravaisLattice> all = all_lattices();
  return all;
}

ParameterValues best_parameters(const BravaisLattice& lattice, KnownTriangulations& known) {
  constexpr int coarsest = 6, finest = 96;
  const std::size_t count = lattice.parameters.size();
  if (count == 0) return {};
  ParameterSearch search{lattice, known, {}};
  search.try_all({std::vector<int>(count), coarsest}, lattice.parameters);
  const std::vector<FreeParameter> neighbors(count, {"", -1, 1});
  while (search.best.denominator < finest) {
    search.best.denominator *= 2;
    for (int& numerator : search.best.numerators) numerator *= 2;
    Rating before;
    do {
      before = search.rating;
      search.try_all(ParameterValues(search.best), neighbors);
    } while (search.rating < before);
  }
  return search.best;
}

std::string_view cubic_symbol(const Gram& gram) {
  const std::array<std::int64_t, 6> p = selling_parameters(gram);
  const std::int64_t largest = std::ranges::max(p);
  const auto equal = std::ranges::count(p, largest), zero = std::ranges::count(p, 0);
  if (equal == 6) return "cI";
  const bool are_opposite = p[0] + p[5] == 0 || p[1] + p[4] == 0 || p[2] + p[3] == 0;
  if (equal == 4 && zero == 2 && are_opposite) return "cF";
  if (equal == 3 && zero == 3) return "cP";
  return {};
}

}  // namespace ccdt::bravais
