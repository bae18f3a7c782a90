#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/small_plcs/small_plc.h"

namespace ccdt {
namespace {

using namespace small_plcs;

SmallPlc tetrahedron() {
  return {{{0, 0, 0}, {50, 3, 1}, {7, 60, 2}, {11, 13, 55}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Two vertices on the two sides of a triangle 0 1 2, so near it that a circumsphere of one of the two tetrahedra at
/// the triangle holds the other vertex: the Delaunay tetrahedra are three, around the edge 3 4.
SmallPlc flat_bipyramid() {
  SmallPlc plc{{{-50, -31, 1}, {53, -30, 0}, {2, 60, 3}, {1, 2, 20}, {-2, 1, -19}}, {}};
  plc.boundary = convex_hull(plc.vertices);
  return plc;
}

/// As above, with the two vertices far away: the Delaunay tetrahedra are two, at the triangle.
SmallPlc long_bipyramid() {
  SmallPlc plc{{{-50, -31, 1}, {53, -30, 0}, {2, 60, 3}, {1, 2, 200}, {-2, 1, -190}}, {}};
  plc.boundary = convex_hull(plc.vertices);
  return plc;
}

/// Schoenhardt's polyhedron, shaken into general position.
SmallPlc schoenhardt() {
  SmallPlc plc{{{100, 0, 0}, {-50, 87, 3}, {-51, -86, -2}, {87, 50, 100}, {-88, 49, 101}, {1, -101, 99}}, {}};
  plc.boundary = {{0, 2, 1}, {3, 4, 5}};
  for (Vertex i = 0; i < 3; ++i) {
    const Vertex j = (i + 1) % 3;
    plc.boundary.push_back({i, j, 3 + j});
    plc.boundary.push_back({i, 3 + j, 3 + i});
  }
  return plc;
}

Trial try_generic(const SmallPlc& plc) {
  EXPECT_TRUE(is_generic(plc));
  EXPECT_TRUE(is_valid(plc));
  Trial trial = try_plc(plc, false);
  EXPECT_EQ(trial.disagreement, "");
  return trial;
}

TEST(SmallPlcs, KnowPiercingFromTouching) {
  const Point a{0, 0, 0}, b{10, 0, 0}, c{0, 10, 0};
  EXPECT_TRUE(pierces({2, 2, 5}, {3, 3, -5}, a, b, c));
  EXPECT_FALSE(pierces({2, 2, 5}, {3, 3, 1}, a, b, c));
  EXPECT_FALSE(pierces({8, 8, 5}, {8, 8, -5}, a, b, c));
  EXPECT_FALSE(pierces({5, 5, 5}, {5, 5, -5}, a, b, c));  // an edge
  EXPECT_FALSE(pierces({2, 2, 5}, {2, 2, 0}, a, b, c));   // its end
}

TEST(SmallPlcs, KnowWhetherInsidesMeet) {
  const std::array<Point, 4> t = {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}};
  const auto meets = [&](const std::vector<Point>& simplex) { return insides_meet(t, simplex); };
  EXPECT_TRUE(meets({{1, 1, 1}, {20, 1, 1}, {1, 20, 1}, {1, 1, 20}}));
  EXPECT_FALSE(meets({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, -10}}));   // a common face
  EXPECT_FALSE(meets({{5, 5, 0}, {20, 1, 1}, {20, 20, 1}, {20, 5, -9}}));  // a corner on an edge
  EXPECT_TRUE(meets({{-5, 2, 2}, {5, 2, 2}}));
  EXPECT_FALSE(meets({{-5, 2, 0}, {5, 2, 0}}));  // along a face
  EXPECT_TRUE(meets({{1, 1, -5}, {2, 1, 9}, {1, 2, 9}}));
  EXPECT_FALSE(meets({{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}));
}

TEST(SmallPlcs, HaveAnInside) {
  SmallPlc plc = tetrahedron();
  plc.vertices = {{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}, {10, 10, 21}, {10, 10, 20}, {10, 10, 19}};
  EXPECT_TRUE(is_inside(plc, {0, 1, 2, 3}));
  EXPECT_FALSE(is_inside(plc, {4}));
  EXPECT_FALSE(is_inside(plc, {5}));  // on a face
  EXPECT_TRUE(is_inside(plc, {6}));
}

TEST(SmallPlcs, HaveAnInsideEvenForACenterOnTheLineOfAnEdge) {
  const SmallPlc dented{
      {{54, 28, 75}, {52, 91, 78}, {80, 50, 75}, {87, 62, 41}, {56, 70, 76}, {74, 56, 63}, {69, 70, 67}},
      {{0, 3, 2}, {1, 2, 3}, {0, 2, 4}, {2, 1, 4}, {1, 0, 4}, {0, 1, 5}, {3, 0, 5}, {1, 3, 6}, {3, 5, 6}, {5, 1, 6}}};
  EXPECT_TRUE(is_inside(dented, {2, 3, 5, 6}));
}

TEST(SmallPlcs, AreRefusedIfTheyCrossThemselvesOrLeaveTheDomain) {
  SmallPlc plc = flat_bipyramid();
  EXPECT_TRUE(is_valid(plc));
  plc.interior = {{0, 1, 2}};
  EXPECT_TRUE(is_valid(plc));
  plc.segments = {{3, 4}};
  EXPECT_FALSE(is_valid(plc));
  SmallPlc dented = schoenhardt();
  EXPECT_TRUE(is_valid(dented));
  dented.segments = {{1, 3}};  // outside, across a reflex side
  EXPECT_FALSE(is_valid(dented));
}

TEST(SmallPlcs, AreRefusedIfTheyHaveAVoid) {
  // Glued tetrahedra all around 1 2 3 4. A file without hole seeds says that this is filled.
  const SmallPlc around_void{
      {{19, 66, 96}, {8, 55, 19}, {30, 94, 84}, {31, 61, 78}, {49, 37, 67}, {25, 34, 8}, {63, 51, 82}},
      {{0, 2, 1},
       {0, 1, 5},
       {0, 6, 2},
       {0, 5, 4},
       {0, 4, 6},
       {1, 2, 3},
       {1, 4, 2},
       {1, 2, 5},
       {1, 3, 4},
       {2, 4, 3},
       {2, 4, 5},
       {2, 6, 4}}};
  EXPECT_TRUE(is_generic(around_void));
  EXPECT_FALSE(is_valid(around_void));
}

TEST(Grazeable, AreReflexEdgesDanglingSegmentsAndFreeEdgesOfFacets) {
  EXPECT_TRUE(grazeable_segments(tetrahedron()).empty());
  SmallPlc plc = flat_bipyramid();
  plc.segments = {{3, 4}};
  EXPECT_EQ(grazeable_segments(plc), (std::vector<Edge>{{3, 4}}));
  EXPECT_EQ(grazeable_segments(schoenhardt()).size(), 3u);  // its three reflex sides
  SmallPlc slit = tetrahedron();
  slit.vertices.push_back({15, 18, 14});
  slit.interior = {{0, 1, 4}};
  EXPECT_EQ(grazeable_segments(slit), (std::vector<Edge>{{0, 4}, {1, 4}}));
}

TEST(Protection, OfAnEdgeIsThatSomeSphereThroughItAndTwoOthersIsEmpty) {
  // In general position an empty sphere grows until it touches two more vertices: the other definition.
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    SmallPlc plc;
    do {
      plc.vertices.assign(8, {});
      std::ranges::generate(plc.vertices, [&] { return random_point(random); });
    } while (!is_generic(plc));
    for (Vertex a = 0; a < 8; ++a)
      for (Vertex b = a + 1; b < 8; ++b) {
        bool edge_is_there = false;
        for (Vertex c = 0; c < 8; ++c) {
          bool face_is_there = false;
          for (Vertex d = 0; d < 8; ++d) {
            if (c == d || c == a || c == b || d == a || d == b) continue;
            face_is_there = face_is_there || is_delaunay(plc.vertices, {a, b, c, d});
          }
          if (c == a || c == b) continue;
          ASSERT_EQ(is_strongly_delaunay(plc.vertices, triangle_of(a, b, c)), face_is_there) << in_words(plc);
          edge_is_there = edge_is_there || face_is_there;
        }
        ASSERT_EQ(is_strongly_delaunay(plc.vertices, edge_of(a, b)), edge_is_there) << in_words(plc);
      }
  }
}

TEST(Theorem1, HoldsForATetrahedron) {
  const Trial trial = try_generic(tetrahedron());
  EXPECT_TRUE(trial.protection.premise());
  EXPECT_TRUE(trial.has_dt);
  EXPECT_EQ(trial.search.first, (std::vector<Tetrahedron>{{0, 1, 2, 3}}));
}

TEST(Theorem1, HoldsForSchoenhardtsPolyhedronWhichHasNoTetrahedralization) {
  const Trial trial = try_generic(schoenhardt());
  EXPECT_FALSE(trial.protection.edges);
  EXPECT_FALSE(trial.has_dt);
  EXPECT_EQ(trial.search.constrained_delaunay, 0u);
  EXPECT_TRUE(trial.engine.has_steiner_vertices);
}

TEST(Theorem1, HoldsForADanglingSegmentThatIsThere) {
  SmallPlc plc = flat_bipyramid();
  plc.segments = {{3, 4}};
  const Trial trial = try_generic(plc);
  EXPECT_TRUE(trial.protection.premise());
  EXPECT_TRUE(trial.has_dt);
  EXPECT_EQ(trial.search.first.size(), 3u);
}

TEST(Theorem1, HoldsForADanglingSegmentThatIsMissing) {
  SmallPlc plc = long_bipyramid();
  plc.segments = {{3, 4}};
  const Trial trial = try_generic(plc);
  EXPECT_TRUE(trial.protection.faces);
  EXPECT_FALSE(trial.protection.edges);
  EXPECT_TRUE(trial.protection.missing_is_loose);
  EXPECT_FALSE(trial.has_dt);
  EXPECT_EQ(trial.search.constrained_delaunay, 0u);
  EXPECT_TRUE(trial.engine.has_steiner_vertices);
}

TEST(Theorem1, HoldsForAFacetThatIsMissingThoughNoEdgeIsAndThereIsACdt) {
  SmallPlc plc = flat_bipyramid();
  plc.interior = {{0, 1, 2}};
  const Trial trial = try_generic(plc);
  EXPECT_TRUE(trial.protection.edges);
  EXPECT_FALSE(trial.protection.faces);
  EXPECT_FALSE(trial.has_dt);
  EXPECT_EQ(trial.search.first, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {0, 1, 2, 4}}));
  EXPECT_FALSE(trial.engine.has_steiner_vertices);
  EXPECT_FALSE(trial.engine.is_protected);
}

TEST(Theorem1, TakesTheDelaunayDiagonalOfAFacetOfFourCorners) {
  SmallPlc plc{{{0, 0, 0}, {40, 1, 0}, {60, 30, 0}, {3, 25, 0}, {20, 12, 30}}, {{3, 2, 1, 0}}};
  for (Vertex i = 0; i < 4; ++i) plc.boundary.push_back({i, (i + 1) % 4, 4});
  const Trial trial = try_generic(plc);
  EXPECT_TRUE(trial.protection.premise());
  EXPECT_TRUE(trial.has_dt);
}

TEST(Theorem1, NeedsItsProvisoThatNoFiveVerticesAreOnASphere) {
  // Five points on a sphere and a segment through the triangle of three: any tetrahedra of them are Delaunay, but no
  // sphere through the segment's ends leaves out the others.
  SmallPlc plc{{{33, 4, 0}, {-23, 24, 0}, {-24, -23, 0}, {4, 0, 33}, {0, 4, -33}}, {}};
  for (const Point& p : plc.vertices) ASSERT_EQ(dot(p, p), 1105);
  plc.boundary = convex_hull(plc.vertices);
  plc.segments = {{3, 4}};
  ASSERT_TRUE(is_generic(plc, true));
  ASSERT_TRUE(is_valid(plc));
  const Trial trial = try_plc(plc, true);
  EXPECT_FALSE(trial.protection.edges);
  EXPECT_TRUE(trial.has_dt);
}

TEST(Theorem1, HoldsAndTheEngineAgreesForRandomPlcsOfAllFamiliesInGeneralPosition) {
  for (const Family& family : families()) {
    Random random(2);
    std::uint64_t with_premise = 0, without = 0;
    for (int i = 0; i < 60; ++i) {
      const Trial trial = try_plc(next_plc(family, random), family.is_cospherical);
      ASSERT_EQ(trial.disagreement, "") << in_words(trial.plc);
      const ProtectionState& protection = trial.protection;
      ASSERT_TRUE(family.is_cospherical || protection.premise() == trial.has_dt) << in_words(trial.plc);
      ASSERT_TRUE(!protection.edges || trial.search.constrained_delaunay > 0) << in_words(trial.plc);
      ++(trial.protection.premise() ? with_premise : without);
    }
    // Or the family would say little.
    EXPECT_GT(with_premise, 5u) << family.name;
    EXPECT_GT(without, 5u) << family.name;
  }
}

TEST(Theorem1, ResultNamesCounterexamplesAndDisagreements) {
  Trial sound{.plc = tetrahedron()};
  sound.protection = {.edges = true, .faces = true};
  sound.has_dt = true;
  sound.search.constrained_delaunay = 1;
  Trial against = sound;
  against.plc = flat_bipyramid();
  against.protection.edges = false;
  Trial broken = sound;
  broken.disagreement = "two answers";
  experiments::FamilyTrials trials{{"test", "", false, nullptr}};
  for (const Trial& trial : {sound, against, sound, broken}) experiments::add_trial(trial, trials);

  const results::ExperimentResult result = experiments::theorem1_result(std::vector{trials});
  EXPECT_FALSE(result.is_good);
  ASSERT_EQ(result.problems.size(), 1u);
  EXPECT_NE(result.problems[0].find("(0 0 0)"), std::string::npos);
  const results::ResultTable& table = result.tables.front();
  EXPECT_NE(results::text_in(table, table.rows[0], "counterexample").find("(-50 -31 1)"), std::string::npos);
  const std::vector<std::pair<const char*, double>> counts = {
      {"cases", 4},      {"premise", 3},     {"dt", 4},           {"against_only_if", 1},
      {"against_if", 0}, {"edges_alone", 1}, {"engine_agrees", 3}};
  for (const auto& [column, count] : counts)
    EXPECT_EQ(results::number_in(table, table.rows[0], column), count) << column;
  EXPECT_NE(result.findings[0].find("3 of 3 "), std::string::npos);
  EXPECT_NE(result.findings[1].find("3 of 4 "), std::string::npos);
}

}  // namespace
}  // namespace ccdt
