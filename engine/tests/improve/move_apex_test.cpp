#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "engine/geometry/predicates.h"
#include "engine/improve/smoothing.h"
#include "engine/tests/improve/star_samples.h"

namespace ccdt {
namespace {

using test::jittered_stars;
using test::Star;

/// Goals that no star reaches, so that the search runs to its end.
const tets::QualityGoal best_r{tets::Objective::r, 1.1, 1.1}, best_sine{tets::Objective::dihedral, 1.1, 1.1};
const tets::QualityGoal best_sine_of_good_r{tets::Objective::r, 0.5, 1.1}, usual{tets::Objective::r, 0.5, 0.34};

bool is_integer(const Point3& p) {
  return p.x == std::round(p.x) && p.y == std::round(p.y) && p.z == std::round(p.z);
}

bool all_positive(const Star& star) {
  return std::all_of(star.faces.begin(), star.faces.end(),
                     [&](const improve::StarFace& f) { return orient3d(f.a, f.b, f.c, star.apex) > 0; });
}

/// Moves the apex and checks the invariants of every move; returns the quality before and after.
std::array<double, 2> move_checked(const tets::QualityGoal& goal, const improve::Freedom& freedom, Star& star) {
  EXPECT_TRUE(all_positive(star));
  const Point3 from = star.apex;
  const double before = improve::worst_of_star(star.faces, goal, from);
  improve::MoveScratch scratch;
  const double after = improve::move_apex(star.faces, goal, freedom, before, scratch, star.apex);
  if (star.apex == from)
    EXPECT_EQ(after, before);
  else
    EXPECT_GT(after, before);
  EXPECT_EQ(after, improve::worst_of_star(star.faces, goal, star.apex));
  EXPECT_TRUE(is_integer(star.apex));
  EXPECT_TRUE(all_positive(star));
  return {before, after};
}

double radius(const Star& star) {
  double squared = 0;
  for (const improve::StarFace& f : star.faces) squared = std::max(squared, squared_length(f.a - star.apex));
  return std::sqrt(squared);
}

/// The best quality on finer and finer grids, each around the best point so far. The apex may move along `directions`.
double best_of_grids(const Star& star, const tets::QualityGoal& goal, std::span<const Point3> directions) {
  Point3 best = star.apex;
  double quality = improve::worst_of_star(star.faces, goal, best);
  const int dimensions = static_cast<int>(directions.size());
  double step = radius(star) / 6;
  for (int level = 0; level < 8; ++level, step *= 0.4) {
    const int n = level == 0 ? 6 : 2;
    const Point3 center = best;
    for (int i = -n; i <= n; ++i) {
      for (int j = dimensions > 1 ? -n : 0; j <= (dimensions > 1 ? n : 0); ++j) {
        for (int k = dimensions > 2 ? -n : 0; k <= (dimensions > 2 ? n : 0); ++k) {
          Point3 there = center + (step * i) * directions[0];
          if (dimensions > 1) there = there + (step * j) * directions[1];
          if (dimensions > 2) there = there + (step * k) * directions[2];
          if (const double w = improve::worst_of_star(star.faces, goal, there); w > quality) quality = w, best = there;
        }
      }
    }
  }
  return quality;
}

constexpr std::array<Point3, 3> all_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// The eight faces of an octahedron of this radius around the origin, seen from inside.
std::vector<improve::StarFace> octahedron(double size) {
  std::vector<improve::StarFace> faces;
  for (const double x : {-size, size}) {
    for (const double y : {-size, size}) {
      for (const double z : {-size, size}) {
        const Point3 a{x, 0, 0}, b{0, y, 0}, c{0, 0, z};
        faces.push_back(orient3d(a, b, c, {}) > 0 ? improve::StarFace{a, b, c} : improve::StarFace{b, a, c});
      }
    }
  }
  return faces;
}

TEST(CellQuality, KnowsTheRegularTetrahedron) {
  const Point3 a{1, 1, 1}, b{-1, -1, 1}, c{-1, 1, -1}, d{1, -1, -1};
  EXPECT_NEAR(std::fabs(tets::inverse_r(a, b, c, d)), 1, 1e-15);
  EXPECT_NEAR(std::fabs(tets::least_sine(a, b, c, d)), std::sqrt(8.0) / 3, 1e-15);
  EXPECT_NEAR(tets::inverse_r(a, b, c, d), -tets::inverse_r(b, a, c, d), 1e-15);
}

TEST(CellQuality, KnowsTheCornerOfACube) {
  const Point3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1}, d{};
  ASSERT_LT(orient3d(a, b, c, d), 0);
  // Edges: three of 1, three of sqrt(2): mean square 3/2. Angles: 90 degrees, and those with tangent sqrt(2).
  EXPECT_NEAR(tets::inverse_r(b, a, c, d), std::numbers::sqrt2 / (1.5 * std::sqrt(1.5)), 1e-15);
  EXPECT_NEAR(tets::least_sine(b, a, c, d), std::sqrt(2.0 / 3), 1e-15);
}

TEST(CellQuality, OfManyIsThatOfEach) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(-20, 20), vertex(0, 99);
  std::vector<Point3> points(100);
  for (Point3& p : points) p = {1.0 * coordinate(random), 1.0 * coordinate(random), 1.0 * coordinate(random)};
  std::vector<delaunay::Cell> cells;
  while (cells.size() < 1001) {
    std::array<std::uint32_t, 4> cell;
    for (std::uint32_t& v : cell) v = static_cast<std::uint32_t>(vertex(random));
    if (orient3d(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]) > 0) cells.push_back({cell, {}});
  }
  for (const tets::QualityGoal& goal : {usual, tets::QualityGoal{tets::Objective::dihedral, 0.5, 0.34}}) {
    std::vector<double> qualities(cells.size());
    tets::compute_qualities(goal, points, cells, qualities);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& [a, b, c, d] = cells[i].vertices;
      EXPECT_EQ(qualities[i], tets::cell_quality(goal, points[a], points[b], points[c], points[d])) << "cell " << i;
    }
  }
}

TEST(StarFunctions, AgreeWithTheQualityOfSingleTetrahedra) {
  improve::ScaledStar scaled;
  for (const Star& star : jittered_stars(0.3, 1)) {
    improve::load_star(star.faces, star.apex, scaled);
    for (const tets::QualityGoal& goal : {best_r, best_sine, usual})
      EXPECT_NEAR(improve::least_quality(goal, {}, scaled), improve::worst_of_star(star.faces, goal, star.apex), 1e-12);
  }
}

/// The value and the gradient of a model belong to the same function: models made at nearby points, in the same order,
/// have values that differ as the gradient predicts.
TEST(StarFunctions, HaveTheGradientsOfFiniteDifferences) {
  constexpr double everything = 100, step = 1e-5;
  improve::ScaledStar scaled;
  improve::LinearModels models, ahead, behind;
  for (const Star& star : jittered_stars(0.3, 2)) {
    improve::load_star(star.faces, star.apex, scaled);
    const Point3 x{0.05, -0.03, 0.02};
    for (const tets::QualityGoal& goal : {best_r, best_sine, tets::QualityGoal{tets::Objective::r, 0.0, 1.1}}) {
      const double least = improve::least_quality(goal, x, scaled);
      improve::model_star(goal, x, least, everything, scaled, models);
      for (const Point3& axis : all_axes) {
        // All three models must get the same `least`, because the surplus of 1 / r is added to it.
        improve::least_quality(goal, x + step * axis, scaled);
        improve::model_star(goal, x + step * axis, least, everything, scaled, ahead);
        improve::least_quality(goal, x - step * axis, scaled);
        improve::model_star(goal, x - step * axis, least, everything, scaled, behind);
        ASSERT_EQ(models.size(), ahead.size());
        ASSERT_EQ(models.size(), behind.size());
        for (std::size_t i = 0; i < models.size(); ++i) {
          const double slope = (ahead.value[i] - behind.value[i]) / (2 * step);
          EXPECT_NEAR(dot(models.gradient[i], axis), slope, 1e-6 * (1 + std::fabs(slope)));
        }
      }
    }
  }
}

TEST(StarFunctions, LeaveOutWhatIsOutOfReach) {
  improve::ScaledStar scaled;
  improve::LinearModels models;
  for (const Star& star : jittered_stars(0.3, 2)) {
    improve::load_star(star.faces, star.apex, scaled);
    for (const tets::QualityGoal& goal : {best_r, best_sine}) {
      const double least = improve::least_quality(goal, {}, scaled);
      improve::model_star(goal, {}, least, 0.1, scaled, models);
      ASSERT_GT(models.size(), 0u);
      const auto [low, high] = std::minmax_element(models.value.begin(), models.value.end());
      EXPECT_NEAR(*low, least, 1e-12);
      EXPECT_LT(*high, least + 0.1);
    }
  }
}

TEST(ProximalStep, FollowsTheOnlyGradient) {
  improve::LinearModels models;
  models.add(1, {1, 2, -2});
  const improve::ProximalStep found = improve::proximal_step(models, 0.5);
  EXPECT_EQ(found.step, (Point3{0.5, 1, -1}));
  EXPECT_EQ(found.least, 1 + 4.5);
}

TEST(ProximalStep, TakesTheLeastCombinationOfGradientsOfEqualValues) {
  improve::LinearModels models;
  models.add(0, {1, 1, 0});
  models.add(0, {1, -1, 0});
  models.add(0, {9, 0, 0});
  const improve::ProximalStep found = improve::proximal_step(models, 1);
  EXPECT_NEAR(squared_length(found.step - Point3{1, 0, 0}), 0, 1e-20);
  EXPECT_NEAR(found.least, 1, 1e-10);
}

TEST(ProximalStep, StaysWhereGradientsSurroundIt) {
  improve::LinearModels models;
  for (const Point3& g : {Point3{1, 0, -1}, Point3{-1, 0, -1}, Point3{0, 1, 1}, Point3{0, -1, 1}}) models.add(2, g);
  models.add(2.5, {3, 3, 3});
  const improve::ProximalStep found = improve::proximal_step(models, 1);
  EXPECT_NEAR(squared_length(found.step), 0, 1e-10);
  EXPECT_LE(found.least, 2 + 1e-6);
}

/// Four planes meet in one point: a step that is long enough ends there.
TEST(ProximalStep, EndsWhereFourModelsMeet) {
  const Point3 summit{0.3, -0.2, 0.1};
  improve::LinearModels models;
  for (const Point3& g : {Point3{1, 0, -1}, Point3{-1, 0, -1}, Point3{0, 1, 1}, Point3{0, -1, 1}})
    models.add(2 - dot(g, summit), g);
  const improve::ProximalStep found = improve::proximal_step(models, 10);
  EXPECT_NEAR(squared_length(found.step - summit), 0, 1e-6);
  EXPECT_NEAR(found.least, 2, 1e-2);
}

/// No model is below the prediction, and no random step is much better, with the cost of its length.
TEST(ProximalStep, IsBetterThanOtherSteps) {
  std::mt19937_64 random(5);
  const auto number = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  for (int round = 0; round < 200; ++round) {
    improve::LinearModels models;
    for (int i = 0; i < 3 + round % 40; ++i) models.add(0.2 * number(), {number(), number(), number() + 0.2});
    const double length = 0.05 * (1 + round % 7);
    const auto least = [&](const Point3& step) {
      double value = 1e9;
      for (std::size_t i = 0; i < models.size(); ++i)
        value = std::min(value, models.value[i] + dot(models.gradient[i], step));
      return value;
    };
    const auto worth = [&](const Point3& step) { return least(step) - squared_length(step) / (2 * length); };
    const improve::ProximalStep found = improve::proximal_step(models, length);
    EXPECT_NEAR(found.least, least(found.step), 1e-12);
    const double gain = worth(found.step) - worth({});
    EXPECT_GE(gain, 0);
    for (int other = 0; other < 200; ++other) {
      const Point3 step = found.step + 0.1 * Point3{number(), number(), number()};
      EXPECT_LE(worth(step), worth(found.step) + 0.05 * gain + 1e-12);
    }
  }
}

TEST(MoveApex, FindsTheCenterOfAnOctahedron) {
  const double size = 0x1p40;
  for (const tets::QualityGoal& goal : {best_r, best_sine}) {
    for (const Point3& start : {Point3{0.3, 0.2, -0.1}, Point3{-0.6, 0.1, 0.2}, Point3{0, 0, 0.95}}) {
      Star star{octahedron(size), size * start};
      star.apex = {std::round(star.apex.x), std::round(star.apex.y), std::round(star.apex.z)};
      move_checked(goal, {}, star);
      EXPECT_LT(std::sqrt(squared_length(star.apex)), 0.02 * size);
    }
  }
}

TEST(MoveApex, IsSeldomWorseThanASearchOfTheWholeStar) {
  for (const tets::QualityGoal& goal : {best_r, best_sine, best_sine_of_good_r}) {
    for (const double jitter : {0.15, 0.3, 0.6}) {
      int stars = 0, close = 0;
      double found = 0, known = 0;
      for (Star& star : jittered_stars(jitter, 3)) {
        if (++stars > 25) break;
        const double best = best_of_grids(star, goal, all_axes);
        const double after = move_checked(goal, {}, star)[1];
        if (after >= 0.95 * best) ++close;
        found += after, known += best;
      }
      EXPECT_GE(close, 22) << "jitter " << jitter;
      EXPECT_GE(found, 0.97 * known) << "jitter " << jitter;
    }
  }
}

TEST(MoveApex, NeverMakesAStarWorse) {
  for (const double jitter : {0.05, 0.3, 1.0, 3.0})
    for (Star& star : jittered_stars(jitter, 4))
      for (const tets::QualityGoal& goal : {best_r, best_sine, best_sine_of_good_r, usual})
        move_checked(goal, {}, star);
}

TEST(MoveApex, SpoilsNoGoodTetrahedraForASmallGain) {
  const auto bad = [](const Star& star) {
    return std::count_if(star.faces.begin(), star.faces.end(), [&](const improve::StarFace& f) {
      return tets::cell_quality(usual, f.a, f.b, f.c, star.apex) < usual.good();
    });
  };
  int small_gains = 0, great_gains = 0;
  for (const double jitter : {0.3, 0.4, 0.6, 1.0}) {
    for (Star& star : jittered_stars(jitter, 10)) {
      const auto bad_before = bad(star);
      const auto [before, after] = move_checked(usual, {}, star);
      if (bad(star) > bad_before) {
        EXPECT_GE(after, 1.05 * before);
        ++great_gains;
      }
      if (after > before && after < 1.05 * before) ++small_gains;
    }
  }
  EXPECT_GT(small_gains, 0);
  EXPECT_GT(great_gains, 0);
}

TEST(MoveApex, LeavesAStarAloneThatIsGoodEnough) {
  Star star{octahedron(0x1p40), {0x1p36, 0, 0}};
  const auto [before, after] = move_checked(usual, {}, star);
  EXPECT_GE(before, usual.good());
  EXPECT_EQ(after, before);
  EXPECT_EQ(star.apex, (Point3{0x1p36, 0, 0}));
}

TEST(MoveApex, GoesNowhereWithoutFreedom) {
  Star star{octahedron(0x1p40), {0x1p39, 0, 0}};
  move_checked(best_r, improve::Freedom{0, {}, {}}, star);
  EXPECT_EQ(star.apex, (Point3{0x1p39, 0, 0}));
}

/// The apex is in an oblique plane through its star; it may take only places that are multiples of the steps away.
TEST(MoveApex, StaysExactlyInAPlane) {
  const improve::Freedom freedom{2, {3 * 0x1p20, 1 * 0x1p20, 2 * 0x1p20}, {-1 * 0x1p20, 5 * 0x1p20, 7 * 0x1p20}};
  int moved = 0;
  for (const tets::QualityGoal& goal : {best_r, best_sine}) {
    for (Star& star : jittered_stars(0.3, 6)) {
      const Point3 from = star.apex;
      move_checked(goal, freedom, star);
      const Point3 move = star.apex - from;
      EXPECT_EQ(orient3d(from, from + freedom.u, from + freedom.v, star.apex), 0);
      const double i = std::round((5 * move.x + move.y) / (16 * 0x1p20));
      const double j = std::round((3 * move.y - move.x) / (16 * 0x1p20));
      EXPECT_EQ(move, i * freedom.u + j * freedom.v);
      if (move != Point3{}) ++moved;
    }
  }
  EXPECT_GT(moved, 20);
}

TEST(MoveApex, StaysExactlyOnALine) {
  const improve::Freedom freedom{1, {3 * 0x1p20, 1 * 0x1p20, 2 * 0x1p20}, {}};
  int moved = 0;
  for (const tets::QualityGoal& goal : {best_r, best_sine}) {
    for (Star& star : jittered_stars(0.3, 6)) {
      const Point3 from = star.apex;
      move_checked(goal, freedom, star);
      const Point3 move = star.apex - from;
      EXPECT_EQ(move, std::round(move.y / 0x1p20) * freedom.u);
      if (move != Point3{}) ++moved;
    }
  }
  EXPECT_GT(moved, 20);
}

TEST(MoveApex, IsSeldomWorseThanASearchOfThePlaneOrTheLine) {
  const std::array<Point3, 2> axes{{{0.6, 0.8, 0}, {0, 0, 1}}};
  for (const int dimensions : {1, 2}) {
    const improve::Freedom freedom{dimensions, 0x1p20 * Point3{3, 4, 0},
                                   dimensions == 2 ? Point3{0, 0, 0x1p20} : Point3{}};
    int stars = 0, close = 0;
    for (Star& star : jittered_stars(0.3, 7)) {
      const double best = best_of_grids(star, best_sine, std::span(axes).first(static_cast<std::size_t>(dimensions)));
      ++stars;
      if (move_checked(best_sine, freedom, star)[1] >= 0.95 * best) ++close;
    }
    EXPECT_GE(close, 0.9 * stars) << dimensions;
  }
}

/// All tetrahedra around the apex are slivers whose height is at most a millionth of their edges.
TEST(MoveApex, LeavesNearlyFlatPlacesAndStaysPositive) {
  const double size = 0x1p40;
  for (const double depth : {0x1p-20, 0x1p-30, 0x1p-40}) {
    for (const tets::QualityGoal& goal : {best_r, best_sine, usual}) {
      // One unit below the tip of the octahedron, and just inside one of its faces.
      Star tip{octahedron(size), {0, 0, size - size * depth}};
      EXPECT_GT(move_checked(goal, {}, tip)[1], 0.3);
      Star face{octahedron(size), {0.25 * size, 0.25 * size, 0.5 * size - size * depth}};
      EXPECT_GT(move_checked(goal, {}, face)[1], 0.3);
    }
  }
  // The whole star is flat: no place in it is good.
  Star flat{octahedron(0x1p20), {0x1p18, 0x1p18, 0}};
  for (improve::StarFace& f : flat.faces)
    for (Point3* const p : {&f.a, &f.b, &f.c}) p->z *= 0x1p-18;
  move_checked(best_r, {}, flat);
  move_checked(best_sine, {}, flat);
}

TEST(MoveApex, CopesWithStarsOfAFewGridUnits) {
  for (const double size : {1.0, 2.0, 3.0, 10.0}) {
    Star star{octahedron(size), {0, 0, size - 1}};
    move_checked(best_r, {}, star);
    move_checked(best_sine, {}, star);
  }
}

TEST(MoveApex, IsTheSameFarFromTheOrigin) {
  const Point3 far{0x1p51 - 0x1p43, 0x1p51 - 0x1p43, -0x1p51 + 0x1p43};
  const auto here = jittered_stars(0.3, 8), there = jittered_stars(0.3, 8, 0x1p40, far);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    Star near = here[i];
    // Moved by an exact vector, so that all differences are the same.
    Star shifted = near;
    for (improve::StarFace& f : shifted.faces) f = {f.a + far, f.b + far, f.c + far};
    shifted.apex = near.apex + far;
    EXPECT_EQ(move_checked(usual, {}, near), move_checked(usual, {}, shifted));
    EXPECT_EQ(shifted.apex, near.apex + far);
    Star other = there[i];
    move_checked(best_sine, {}, other);
  }
}

TEST(MoveApex, ReachesAGoalWhereASearchDoes) {
  int within_reach = 0, reached = 0;
  for (Star& star : jittered_stars(0.2, 9)) {
    if (improve::worst_of_star(star.faces, usual, star.apex) >= usual.good()) continue;
    if (best_of_grids(star, usual, all_axes) < usual.good()) continue;
    ++within_reach;
    if (move_checked(usual, {}, star)[1] >= usual.good()) ++reached;
  }
  EXPECT_GE(within_reach, 2);
  EXPECT_EQ(reached, within_reach);
}

}  // namespace
}  // namespace ccdt
