#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/experiments/bravais/bravais_lattices.h"

namespace ccdt {
namespace {

using namespace bravais;

const BravaisLattice& lattice(std::string_view symbol) {
  return *std::ranges::find(bravais_lattices(), symbol, &BravaisLattice::symbol);
}

Gram cubic_gram(std::string_view symbol) {
  return lattice(symbol).gram({});
}

UnitCellQuality quality(const Gram& gram, Choice choice = Choice::best) {
  KnownTriangulations known;
  return quality_of(unit_cell(gram, choice, known));
}

std::int64_t six_volumes_of_cells(const Triangulation& cells) {
  std::int64_t sum = 0;
  for (const Cell& cell : cells) sum += std::abs(small_plcs::six_volumes(cell[0], cell[1], cell[2], cell[3]));
  return sum;
}

/// The numbers of vertices of the Delaunay polytopes, sorted.
std::vector<std::size_t> polytope_sizes(const Gram& gram) {
  std::vector<std::size_t> sizes;
  for (const Polytope& polytope : delaunay_polytopes(gram).polytopes) sizes.push_back(polytope.size());
  std::ranges::sort(sizes);
  return sizes;
}

/// A lattice of each kind, without any symmetry beyond that of its kind.
ParameterValues generic_values(const BravaisLattice& lattice) {
  const std::vector<int> values = {97, 131, -23, -17, 11};
  ParameterValues generic{{}, 83};
  for (std::size_t i = 0; i < lattice.parameters.size(); ++i)
    generic.numerators.push_back(lattice.symbol == "hR" ? 31 : values[i]);
  return generic;
}

/// The lattice whose reduced basis has these parameters (Selling): vectors i and j have the inner product -p_ij.
Gram of_selling(const std::array<std::int64_t, 6>& p) {
  const auto [p01, p02, p03, p12, p13, p23] = p;
  return {p01 + p12 + p13, p02 + p12 + p23, p03 + p13 + p23, -p12, -p13, -p23};
}

/// All lattices whose parameters of that kind are at most 3: near ties, ties, and all kinds of polytopes.
std::vector<Gram> small_lattices() {
  std::vector<Gram> all;
  std::array<std::int64_t, 6> p{};
  for (int code = 0; code < 4096; ++code) {
    for (std::size_t i = 0; i < 6; ++i) p[i] = (code >> (2 * i)) & 3;
    if (is_positive_definite(of_selling(p))) all.push_back(of_selling(p));
  }
  return all;
}

TEST(BravaisLattices, AreFourteenAndPositiveDefinite) {
  EXPECT_EQ(bravais_lattices().size(), 14u);
  for (const BravaisLattice& one : bravais_lattices())
    EXPECT_TRUE(is_positive_definite(one.gram(generic_values(one)))) << one.name;
}

TEST(BravaisLattices, HaveDelaunayPolytopesThatFillTheUnitCell) {
  KnownTriangulations known;
  for (const BravaisLattice& one : bravais_lattices()) {
    const Gram gram = one.gram(generic_values(one));
    std::int64_t volume = 0;
    for (const Polytope& polytope : delaunay_polytopes(gram).polytopes) volume += six_volumes(polytope);
    EXPECT_EQ(volume, 6) << one.name;
    for (const Choice choice : {Choice::best, Choice::worst})
      EXPECT_EQ(six_volumes_of_cells(unit_cell(gram, choice, known).cells), 6) << one.name;
  }
}

TEST(BravaisLattices, HaveDelaunayPolytopesThatFillTheUnitCellOfAnyLattice) {
  for (const Gram& gram : small_lattices()) {
    std::int64_t volume = 0;
    for (const Polytope& polytope : delaunay_polytopes(gram).polytopes) volume += six_volumes(polytope);
    ASSERT_EQ(volume, 6);
  }
}

TEST(BravaisLattices, HaveThePolytopesOfTheirVoronoiCells) {
  // A cube, a truncated octahedron, a rhombic dodecahedron, a hexagonal prism, an elongated dodecahedron.
  EXPECT_EQ(polytope_sizes(cubic_gram("cP")), (std::vector<std::size_t>{8}));
  EXPECT_EQ(polytope_sizes(cubic_gram("cI")), (std::vector<std::size_t>{4, 4, 4, 4, 4, 4}));
  EXPECT_EQ(polytope_sizes(cubic_gram("cF")), (std::vector<std::size_t>{4, 4, 6}));
  EXPECT_EQ(polytope_sizes(lattice("hP").gram({{1}, 1})), (std::vector<std::size_t>{6, 6}));
  EXPECT_EQ(polytope_sizes(lattice("tI").gram({{3}, 1})), (std::vector<std::size_t>{4, 4, 5, 5}));
  EXPECT_EQ(polytope_sizes(lattice("aP").gram(generic_values(lattice("aP")))), (std::vector<std::size_t>(6, 4)));
}

TEST(BravaisLattices, HaveEmptySpheres) {
  for (const BravaisLattice& one : bravais_lattices()) {
    const Gram gram = one.gram(generic_values(one));
    const std::vector<Point> near = neighbors_of_origin(reduced(gram));
    for (const Point& v : near)  // no shorter vector in its class
      for (const Point& w : near) EXPECT_GE(squared_length(reduced(gram), v + 2 * w), squared_length(reduced(gram), v));
    EXPECT_GE(near.size(), 14u);
  }
}

TEST(BravaisLattices, HaveTheKnownQualityOfTheCubicOnes) {
  const UnitCellQuality fcc = quality(cubic_gram("cF")), bcc = quality(cubic_gram("cI")),
                        sc = quality(cubic_gram("cP"));
  EXPECT_EQ(bcc.worst_squared_r, Fraction(125, 108));
  EXPECT_EQ(bcc.best_squared_r, Fraction(125, 108));
  EXPECT_NEAR(bcc.worst_r, 1.0758, 1e-4);
  EXPECT_NEAR(bcc.smallest_dihedral, 60, 1e-9);
  EXPECT_NEAR(bcc.largest_dihedral, 90, 1e-9);
  EXPECT_EQ(fcc.cells, 6u);
  EXPECT_EQ(fcc.regular, 2u);
  EXPECT_EQ(fcc.best_squared_r, Fraction(1));
  EXPECT_EQ(fcc.worst_squared_r, Fraction(343, 216));
  EXPECT_NEAR(fcc.worst_r, 1.260, 1e-3);
  EXPECT_NEAR(fcc.mean_r, (2 + 4 * std::sqrt(343.0 / 216)) / 6, 1e-12);
  EXPECT_NEAR(fcc.smallest_dihedral, 54.7356, 1e-4);
  EXPECT_NEAR(fcc.largest_dihedral, 109.4712, 1e-4);
  // The cube in five: a regular tetrahedron with twice the volume of each of the four corners.
  EXPECT_EQ(sc.cells, 5u);
  EXPECT_EQ(sc.regular, 1u);
  EXPECT_EQ(sc.worst_squared_r, Fraction(27, 16));
  EXPECT_NEAR(sc.mean_r, (1 + 4 * std::sqrt(27.0 / 16)) / 5, 1e-12);
  EXPECT_NEAR(sc.mean_r_by_volume, (1 + 2 * std::sqrt(27.0 / 16)) / 3, 1e-12);
  EXPECT_NEAR(sc.worst_aspect, 1.3660, 1e-4);
  EXPECT_NEAR(sc.worst_radius_edge, std::sqrt(0.75), 1e-12);
}

TEST(BravaisLattices, AreTheSameInAnyBasis) {
  const std::vector<std::array<Point, 3>> bases = {
      {{{1, 0, 0}, {3, 1, 0}, {-2, 5, 1}}}, {{{0, 1, 0}, {0, 0, -1}, {1, 2, 4}}}, {{{2, 1, 1}, {1, 1, 0}, {1, 0, 2}}}};
  for (const BravaisLattice& one : bravais_lattices()) {
    const Gram gram = one.gram(generic_values(one));
    const UnitCellQuality expected = quality(gram);
    for (const auto& basis : bases) {
      ASSERT_EQ(std::abs(small_plcs::determinant(basis[0], basis[1], basis[2])), 1);
      const Gram other = of_vectors(gram, basis);
      EXPECT_EQ(squared_volume(other), squared_volume(gram));
      EXPECT_EQ(polytope_sizes(other), polytope_sizes(gram)) << one.name;
      const UnitCellQuality found = quality(other);
      EXPECT_EQ(found.worst_squared_r, expected.worst_squared_r) << one.name;
      EXPECT_EQ(found.best_squared_r, expected.best_squared_r) << one.name;
      EXPECT_NEAR(found.mean_r, expected.mean_r, 1e-12) << one.name;
      EXPECT_NEAR(found.smallest_dihedral, expected.smallest_dihedral, 1e-9) << one.name;
      EXPECT_NEAR(found.largest_dihedral, expected.largest_dihedral, 1e-9) << one.name;
    }
  }
}

TEST(BravaisLattices, HaveTheSameOctahedraForEveryDiagonal) {
  EXPECT_EQ(quality(cubic_gram("cF"), Choice::worst).worst_squared_r, Fraction(343, 216));
  EXPECT_EQ(quality(cubic_gram("cP"), Choice::worst).worst_squared_r, Fraction(1331, 432));
}

TEST(Triangulations, AreAllThoseOfCubeOctahedronPrismAndPyramid) {
  const std::vector<Point> square = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  Polytope cube = square, pyramid = square;
  for (const Point& p : square) cube.push_back(p + Point{0, 0, 1});
  pyramid.push_back({0, 0, 1});
  EXPECT_EQ(all_triangulations(cube).size(), 74u);
  EXPECT_EQ(all_triangulations(pyramid).size(), 2u);
  EXPECT_EQ(all_triangulations({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}}).size(), 6u);
  EXPECT_EQ(all_triangulations({{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}).size(), 3u);
  std::vector<std::size_t> in_five;
  for (const Triangulation& cells : all_triangulations(cube)) {
    EXPECT_EQ(six_volumes_of_cells(cells), 6);
    if (cells.size() == 5) in_five.push_back(cells.size());
  }
  EXPECT_EQ(in_five.size(), 2u);
}

TEST(BestParameters, AreThoseOfTheCubicLatticesOrOfTheHexagonalOne) {
  KnownTriangulations known;
  const std::map<std::string_view, std::string_view> expected = {{"tP", "cP"}, {"tI", "cI"}, {"oP", "cP"}, {"oC", "cP"},
                                                                 {"oI", "cI"}, {"oF", "cI"}, {"hP", ""},   {"hR", "cI"},
                                                                 {"mP", "cP"}, {"mC", "cI"}, {"aP", "cI"}};
  for (const BravaisLattice& one : bravais_lattices()) {
    if (one.parameters.empty()) continue;
    const Gram gram = one.gram(best_parameters(one, known));
    EXPECT_EQ(cubic_symbol(gram), expected.at(one.symbol)) << one.name;
    if (one.symbol != "hP") continue;
    EXPECT_EQ(quality(gram).worst_squared_r, Fraction(25, 12));  // (c/a)^2 = 5/8
  }
}

TEST(BestParameters, AreSeenToBeCubic) {
  for (const char* symbol : {"cP", "cI", "cF"}) EXPECT_EQ(cubic_symbol(cubic_gram(symbol)), symbol);
  EXPECT_EQ(cubic_symbol(lattice("tI").gram({{2}, 1})), "cF");
  EXPECT_EQ(cubic_symbol(lattice("tI").gram({{3}, 2})), "");
  EXPECT_EQ(cubic_symbol(lattice("hR").gram({{0}, 1})), "cP");
  EXPECT_EQ(cubic_symbol(lattice("hP").gram({{1}, 1})), "");
}

TEST(BodyCenteredCubic, IsTheBestOfAllLatticesByEveryCriterionButTheShareOfRegularTetrahedra) {
  const UnitCellQuality bcc = quality(cubic_gram("cI"));
  KnownTriangulations known;
  for (const Gram& gram : small_lattices()) {
    const UnitCellQuality other = quality_of(unit_cell(gram, Choice::best, known));
    ASSERT_GE(other.worst_squared_r, bcc.worst_squared_r);
    ASSERT_GE(other.mean_r, bcc.mean_r - 1e-9);
    ASSERT_GE(other.mean_r_by_volume, bcc.mean_r_by_volume - 1e-9);
    ASSERT_LE(other.smallest_dihedral, bcc.smallest_dihedral + 1e-9);
    ASSERT_GE(other.largest_dihedral, bcc.largest_dihedral - 1e-9);
  }
}

}  // namespace
}  // namespace ccdt
