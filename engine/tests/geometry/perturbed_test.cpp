#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/geometry/predicates.h"
#include "engine/tests/geometry/numbers_cases.h"
#include "engine/tests/geometry/numbers_reference.h"

namespace ccdt {
namespace {

using namespace test;

std::array<Point3, 5> first_five(const std::array<Point3, 6>& p) {
  return {p[0], p[1], p[2], p[3], p[4]};
}

int insphere_of(const std::array<Point3, 5>& p, const std::array<std::uint32_t, 5>& ranks) {
  return insphere_perturbed(p[0], p[1], p[2], p[3], p[4], ranks);
}

/// The sign of insphere plus heights times powers of epsilon, by the coefficients from the greatest rank down.
int first_coefficient(const std::array<Point3, 5>& p, const std::array<std::uint32_t, 5>& ranks) {
  if (const int sign = reference::insphere(p[0], p[1], p[2], p[3], p[4]); sign != 0) return sign;
  std::array<std::size_t, 5> order = {0, 1, 2, 3, 4};
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return ranks[i] > ranks[j]; });
  for (const std::size_t i : order)
    if (const int sign = reference::height_coefficient(p, i); sign != 0) return sign;
  return 0;
}

template <class Case>
void for_all_families(int cases_per_family, const Case& one) {
  Random random(1981);
  for (const Family family : all_families)
    for (int i = 0; i < cases_per_family; ++i) one(random, draw_points(random, family));
}

TEST(PerturbedInsphere, TakesTheFirstCoefficientThatIsNotZero) {
  int disagreements = 0, ties = 0;
  for_all_families(cases(270000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    const auto ranks = draw_ranks<5>(random);
    disagreements += insphere_of(p, ranks) != first_coefficient(p, ranks);
    ties += insphere(p[0], p[1], p[2], p[3], p[4]) == 0;
  });
  EXPECT_EQ(disagreements, 0);
  EXPECT_GT(ties, cases(100000));
}

TEST(PerturbedInsphere, EqualsTheDeterminantWithATinyEpsilon) {
  int disagreements = 0;
  for_all_families(cases(12000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    const auto ranks = draw_ranks<5>(random);
    disagreements += insphere_of(p, ranks) != reference::insphere_with_epsilon(p, ranks);
  });
  EXPECT_EQ(disagreements, 0);
}

TEST(PerturbedInsphere, ChangesItsSignWithEveryExchangeOfTwoVertices) {
  int disagreements = 0;
  for_all_families(cases(100000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    const auto ranks = draw_ranks<5>(random);
    const std::size_t i = random() % 5, j = (i + 1 + random() % 4) % 5;
    auto q = p;
    auto swapped_ranks = ranks;
    std::swap(q[i], q[j]);
    std::swap(swapped_ranks[i], swapped_ranks[j]);
    disagreements += insphere_of(p, ranks) != -insphere_of(q, swapped_ranks);
  });
  EXPECT_EQ(disagreements, 0);
}

TEST(PerturbedInsphere, IsZeroOnlyForFiveCoplanarPoints) {
  int disagreements = 0, zeros = 0;
  for_all_families(cases(60000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    bool coplanar = true;
    for (std::size_t i = 0; i < 5; ++i) coplanar = coplanar && reference::height_coefficient(p, i) == 0;
    const bool zero = insphere_of(p, draw_ranks<5>(random)) == 0;
    disagreements += zero != coplanar;
    zeros += zero;
  });
  EXPECT_EQ(disagreements, 0);
  EXPECT_GT(zeros, cases(1000));
}

TEST(PerturbedInsphere, OrderOfTheRanksDecidesNotTheirValues) {
  for_all_families(cases(5000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    const auto ranks = draw_ranks<5>(random);
    std::array<std::uint32_t, 5> places;
    for (std::size_t i = 0; i < 5; ++i)
      places[i] = static_cast<std::uint32_t>(
          std::count_if(ranks.begin(), ranks.end(), [&](std::uint32_t other) { return other < ranks[i]; }));
    ASSERT_EQ(insphere_of(p, ranks), insphere_of(p, places));
  });
}

/// What the Delaunay insertion relies on: a new vertex is outside every sphere that it is on.
TEST(PerturbedInsphere, PutsTheGreatestRankOutsideTheSphereThatItIsOn) {
  int ties = 0;
  for_all_families(cases(20000), [&](Random& random, const auto& six) {
    const auto p = first_five(six);
    auto ranks = draw_ranks<5>(random);
    std::iter_swap(std::max_element(ranks.begin(), ranks.end()), ranks.end() - 1);
    if (orient3d(p[0], p[1], p[2], p[3]) <= 0 || insphere(p[0], p[1], p[2], p[3], p[4]) != 0) return;
    ASSERT_EQ(insphere_of(p, ranks), -1);
    ++ties;
  });
  EXPECT_GT(ties, cases(1000));
}

/// Four points of one plane, and two more above and below them; nothing if the first three are collinear.
struct PlanarCase {
  std::array<Point3, 4> p;
  Point3 above, below;
};

bool draw_planar_case(Random& random, PlanarCase& result) {
  constexpr std::array families = {Family::lattice, Family::plane, Family::segments, Family::sphere};
  const Family family = families[random() % families.size()];
  auto six = draw_points(random, family);
  if (family == Family::sphere || family == Family::lattice) {
    // A plane of the lattice or of the sphere: the points of a circle.
    const int axis = static_cast<int>(random() % 3);
    const auto coordinate = [axis](Point3& q) -> double& { return axis == 0 ? q.x : axis == 1 ? q.y : q.z; };
    for (int i = 1; i < 4; ++i) coordinate(six[i]) = coordinate(six[0]);
  }
  result.p = {six[0], six[1], six[2], six[3]};
  if (orient3d(six[0], six[1], six[2], six[3]) != 0) return false;
  for (const auto family_of_apex : {Family::anywhere, Family::lattice}) {
    const auto apexes = draw_points(random, family_of_apex);
    const int side = orient3d(six[0], six[1], six[2], apexes[0]), other = orient3d(six[0], six[1], six[2], apexes[1]);
    if (side * other >= 0) continue;
    result.above = apexes[side > 0 ? 0 : 1];
    result.below = apexes[side > 0 ? 1 : 0];
    return true;
  }
  return false;
}

int incircle_of(const std::array<Point3, 4>& p, const Point3& apex, const std::array<std::uint32_t, 4>& ranks) {
  return incircle_perturbed(p[0], p[1], p[2], apex, p[3], ranks);
}

TEST(PerturbedIncircle, EqualsThePlanarDeterminantWithATinyEpsilon) {
  Random random(3);
  int done = 0, disagreements = 0, ties = 0;
  while (done < cases(150000)) {
    PlanarCase planar;
    if (!draw_planar_case(random, planar)) continue;
    const auto ranks = draw_ranks<4>(random);
    const int sign = incircle_of(planar.p, planar.above, ranks);
    disagreements += sign == 0 || sign != reference::incircle_with_epsilon(planar.p, ranks);
    ties += insphere(planar.p[0], planar.p[1], planar.p[2], planar.above, planar.p[3]) == 0;
    ++done;
  }
  EXPECT_EQ(disagreements, 0);
  EXPECT_GT(ties, done / 20);
}

TEST(PerturbedIncircle, DependsNeitherOnTheApexNorOnTheOrderOfTheCorners) {
  Random random(4);
  int done = 0, disagreements = 0;
  while (done < cases(200000)) {
    PlanarCase planar;
    if (!draw_planar_case(random, planar)) continue;
    const auto ranks = draw_ranks<4>(random);
    const int sign = incircle_of(planar.p, planar.above, ranks);
    const auto& p = planar.p;
    disagreements +=
        sign != incircle_of({p[1], p[2], p[0], p[3]}, planar.above, {ranks[1], ranks[2], ranks[0], ranks[3]});
    disagreements +=
        sign != incircle_of({p[0], p[2], p[1], p[3]}, planar.below, {ranks[0], ranks[2], ranks[1], ranks[3]});
    ++done;
  }
  EXPECT_EQ(disagreements, 0);
}

/// Four points of a plane have exactly one Delaunay triangulation: d is in the circle of abc if and only if, for a
/// convex quadrilateral, b is in that of acd.
TEST(PerturbedIncircle, AQuadrilateralHasExactlyOneDelaunayDiagonal) {
  Random random(5);
  int done = 0;
  while (done < cases(50000)) {
    PlanarCase planar;
    if (!draw_planar_case(random, planar)) continue;
    const auto& [a, b, c, d] = planar.p;
    if (orient3d(a, c, d, planar.above) <= 0) continue;
    if (orient3d(a, b, d, planar.above) <= 0 || orient3d(b, c, d, planar.above) <= 0) continue;
    const auto ranks = draw_ranks<4>(random);
    ASSERT_EQ(incircle_of({a, b, c, d}, planar.above, ranks),
              incircle_of({a, c, d, b}, planar.above, {ranks[0], ranks[2], ranks[3], ranks[1]}));
    ASSERT_EQ(incircle_of({a, b, c, d}, planar.above, ranks),
              -incircle_of({a, b, d, c}, planar.above, {ranks[0], ranks[1], ranks[3], ranks[2]}));
    ++done;
  }
}

TEST(CentroidOrientation, EqualsTheSideOfAPointATinyEpsilonFromTheCentroid) {
  int disagreements = 0, zeros = 0;
  for_all_families(cases(40000), [&](Random&, const auto& p) {
    const int sign = orient3d_centroid(p[0], p[1], p[2], p[3], p[4], p[5]);
    disagreements += sign != reference::orient3d_centroid_with_epsilon(p[0], p[1], p[2], p[3], p[4], p[5]);
    zeros += sign == 0;
  });
  EXPECT_EQ(disagreements, 0);
  EXPECT_GT(zeros, cases(1000));
}

TEST(CentroidOrientation, IsDecidedByTheMovedCentroidWhereTheCentroidIsInThePlane) {
  const Point3 p{0, 0, 0}, q{1, 0, 0}, r{0, 1, 0}, a{0, 0, -1}, b{5, 0, -1}, c{0, 5, 2};
  EXPECT_EQ(orient3d_centroid(p, q, r, a, b, c), 1);  // b is as deep as a: c decides
  EXPECT_EQ(orient3d_centroid(p, q, r, c, b, a), -1);
  EXPECT_EQ(orient3d_centroid(p, r, q, a, b, c), -1);
  EXPECT_EQ(orient3d_centroid(p, q, r, p, q, {7, 7, 0}), 0);
  EXPECT_EQ(orient3d_centroid(p, q, {2, 0, 0}, a, b, c), 0);
}

}  // namespace
}  // namespace ccdt
