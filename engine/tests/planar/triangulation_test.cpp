#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "engine/tests/planar/planar_test_plane.h"

namespace ccdt {
namespace {

using namespace planar_test;
using Status = planar::TriangulationResult::Status;
using Edges = std::vector<planar::Edge>;

planar::TriangulationResult triangulate(const IntegerPlane& plane, const Edges& edges, const planar::Carving& carving) {
  return planar::triangulate<IntegerPlane>(all_vertices(plane), edges, plane, carving);
}

/// Of the whole convex hull.
planar::TriangulationResult triangulate(const IntegerPlane& plane, const Edges& edges) {
  planar::TriangulationResult result = planar::delaunay<IntegerPlane>(all_vertices(plane), plane);
  if (result) planar::insert_edges<IntegerPlane>(result, edges, plane);
  return result;
}

/// Appends a closed polygon to the points and its edges to the list.
void add_polygon(IntegerPlane& plane, Edges& edges, const std::vector<IntegerPoint>& corners) {
  const auto first = static_cast<std::uint32_t>(plane.points.size()),
             count = static_cast<std::uint32_t>(corners.size());
  plane.points.insert(plane.points.end(), corners.begin(), corners.end());
  for (std::uint32_t i = 0; i < count; ++i) edges.push_back(edge(first + i, first + (i + 1) % count));
}

std::vector<IntegerPoint> square(std::int64_t low, std::int64_t high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}};
}

// ---- From triangles -------------------------------------------------------------------------------------------------

TEST(PlanarFromTriangles, FindsNeighborsBordersAndConstraints) {
  const planar::Triangulation t =
      planar::from_triangles(Triangles{triangle(70, 10, 20), triangle(70, 20, 30)}, Edges{edge(30, 20)});
  EXPECT_EQ(t.neighbors[0], (std::array{none, 1u, none}));
  EXPECT_EQ(t.neighbors[1], (std::array{none, none, 0u}));
  EXPECT_EQ(planar::border_edges(t), (Edges{edge(10, 20), edge(10, 70), edge(20, 30), edge(30, 70)}));
  EXPECT_EQ(constrained_edges(t), Edges{edge(20, 30)});
  EXPECT_TRUE(planar::find_edge(t, VertexId(20u), VertexId(70u)));
  EXPECT_FALSE(planar::find_edge(t, VertexId(10u), VertexId(30u)));
}

TEST(PlanarFromTriangles, FindsInnerEdgesAtAPinchedVertex) {
  // Two fans of two triangles each that share vertex 0 only.
  const planar::Triangulation t =
      planar::from_triangles(Triangles{triangle(0, 1, 2), triangle(0, 2, 3), triangle(0, 4, 5), triangle(0, 5, 6)});
  EXPECT_TRUE(planar::find_edge(t, VertexId(0u), VertexId(2u)));
  EXPECT_TRUE(planar::find_edge(t, VertexId(0u), VertexId(5u)));
}

void expect_defect(const Triangles& triangles, const Edges& constrained) {
  try {
    planar::from_triangles(triangles, constrained);
    ADD_FAILURE() << "no defect was found";
  } catch (const InputError& defect) {
    EXPECT_FALSE(defect.remedy().empty());
  }
}

TEST(PlanarFromTriangles, ReportsAnEdgeWithThreeTriangles) {
  expect_defect({triangle(0, 1, 2), triangle(1, 0, 3), triangle(0, 1, 4)}, {});
}

TEST(PlanarFromTriangles, ReportsNeighborsOfOppositeOrientation) {
  expect_defect({triangle(0, 1, 2), triangle(0, 1, 3)}, {});
}

TEST(PlanarFromTriangles, ReportsAConstraintThatIsNoEdge) {
  expect_defect({triangle(0, 1, 2), triangle(0, 2, 3)}, {edge(1, 3)});
}

// ---- Flips ----------------------------------------------------------------------------------------------------------

TEST(PlanarLegalize, FlipsTheLongDiagonalOfARhombus) {
  const IntegerPlane plane{{{-5, 0}, {0, -1}, {5, 0}, {0, 1}}};
  const Triangles long_diagonal{triangle(0, 1, 2), triangle(0, 2, 3)};
  planar::Triangulation t = planar::from_triangles(long_diagonal);
  planar::legalize(t, plane);
  EXPECT_EQ(canonical(t), (Triangles{triangle(0, 1, 3), triangle(1, 2, 3)}));
  expect_sound(t, plane);

  t = planar::from_triangles(long_diagonal, Edges{edge(0, 2)});
  planar::legalize(t, plane);
  EXPECT_EQ(canonical(t), long_diagonal);
}

TEST(PlanarLegalize, LeadsFromABadTriangulationToTheDelaunayTriangulation) {
  // A fan from one corner of a convex polygon is far from Delaunay.
  const IntegerPlane circle = circle_points(5 * 13 * 17 * 29);
  std::vector<std::uint32_t> around(circle.points.size());
  std::iota(around.begin(), around.end(), 0u);
  std::sort(around.begin(), around.end(), [&](std::uint32_t i, std::uint32_t j) {
    const auto upper = [&](std::uint32_t k) {
      return circle.points[k].y > 0 || (circle.points[k].y == 0 && circle.points[k].x > 0);
    };
    if (upper(i) != upper(j)) return upper(i);
    return circle.points[i].x * circle.points[j].y - circle.points[i].y * circle.points[j].x > 0;
  });
  Triangles fan;
  for (std::size_t i = 2; i < around.size(); ++i) fan.push_back(triangle(around[0], around[i - 1], around[i]));
  planar::Triangulation t = planar::from_triangles(fan);
  const std::int64_t area = twice_area(t, circle);
  planar::legalize(t, circle);
  expect_sound(t, circle);
  EXPECT_EQ(twice_area(t, circle), area);
  EXPECT_EQ(canonical(t), canonical(triangulate(circle, {}).triangulation));
}

// ---- Splits ---------------------------------------------------------------------------------------------------------

TEST(PlanarSplitEdge, HandsTheConstraintToTheHalves) {
  const IntegerPlane plane{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}, {2, 0}}};
  planar::Triangulation t = planar::from_triangles(Triangles{triangle(0, 1, 2), triangle(0, 2, 3)}, Edges{edge(0, 2)});
  ASSERT_TRUE(planar::split_edge(t, VertexId(2u), VertexId(0u), VertexId(4u), plane));
  ASSERT_TRUE(planar::split_edge(t, VertexId(0u), VertexId(1u), VertexId(5u), plane));
  expect_sound(t, plane);
  EXPECT_EQ(constrained_edges(t), (Edges{edge(0, 4), edge(2, 4)}));
  EXPECT_EQ(planar::border_edges(t), (Edges{edge(0, 3), edge(0, 5), edge(1, 2), edge(1, 5), edge(2, 3)}));
  EXPECT_EQ(twice_area(t, plane), 32);
  EXPECT_FALSE(planar::find_edge(t, VertexId(0u), VertexId(2u)));
  EXPECT_FALSE(planar::split_edge(t, VertexId(0u), VertexId(2u), VertexId(4u), plane));
}

/// Bisects the constrained edges of a triangulation repeatedly; new vertices are appended to the plane.
std::size_t bisect_constraints(planar::Triangulation& t, IntegerPlane& plane, int rounds) {
  std::size_t splits = 0;
  for (int round = 0; round < rounds; ++round) {
    for (const auto& [a, b] : constrained_edges(t)) {
      const IntegerPoint p = plane.points[a], q = plane.points[b];
      const VertexId middle(plane.points.size());
      plane.points.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
      EXPECT_TRUE(planar::split_edge(t, a, b, middle, plane));
      ++splits;
    }
  }
  return splits;
}

TEST(PlanarSplitEdge, GivesTheSameAsATriangulationFromNothing) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    IntegerPlane plane;
    Edges edges;
    add_polygon(plane, edges, square(0, 1024));
    add_polygon(plane, edges, square(256, 512));
    edges.push_back(edge(0, 4));
    edges.push_back(edge(2, 6));
    for (const IntegerPoint& p : random_points(10, 128, seed).points) plane.points.push_back({520 + 2 * p.x, 64 + p.y});
    planar::Triangulation t = triangulate(plane, edges).triangulation;
    bisect_constraints(t, plane, 3);
    expect_sound(t, plane);
    expect_locally_delaunay(t, plane);
    EXPECT_EQ(twice_area(t, plane), 2 * 1024 * 1024);
    EXPECT_EQ(canonical(t), canonical(triangulate(plane, edges).triangulation));
  }
}

TEST(PlanarSplitEdge, TakesConstantEffortOnALargeFacet) {
  IntegerPlane plane;
  Edges edges;
  add_polygon(plane, edges, square(0, 1 << 16));
  planar::Triangulation t = triangulate(plane, edges).triangulation;
  plane.calls = 0;
  const std::size_t splits = bisect_constraints(t, plane, 13);
  ASSERT_EQ(splits, 4u * 8191u);
  EXPECT_LT(plane.calls, 40 * splits);
  EXPECT_EQ(twice_area(t, plane), std::int64_t{2} << 32);
}

// ---- Constraints ----------------------------------------------------------------------------------------------------

TEST(PlanarConstraint, IsSplitByAVertexOnIt) {
  const IntegerPlane plane{{{0, 0}, {12, 0}, {4, 0}, {2, 1}, {3, -1}, {6, 2}, {8, -2}, {10, 1}, {9, -1}}};
  planar::Triangulation t = triangulate(plane, {}).triangulation;
  const auto result = planar::insert_constraint(t, VertexId(0u), VertexId(1u), plane);
  ASSERT_TRUE(result.inserted);
  EXPECT_EQ(result.parts, (Edges{edge(0, 2), edge(2, 1)}));
  EXPECT_EQ(constrained_edges(t), (Edges{edge(0, 2), edge(1, 2)}));
  expect_sound(t, plane);
  expect_locally_delaunay(t, plane);
}

TEST(PlanarConstraint, ReportsTheConstraintThatItCrosses) {
  const IntegerPlane plane{{{-4, 0}, {4, 0}, {0, -4}, {0, 4}}};
  planar::Triangulation t = triangulate(plane, {edge(0, 1)}).triangulation;
  const auto result = planar::insert_constraint(t, VertexId(2u), VertexId(3u), plane);
  EXPECT_FALSE(result.inserted);
  EXPECT_EQ(std::set(result.obstacle.begin(), result.obstacle.end()), (std::set{VertexId(0u), VertexId(1u)}));
  EXPECT_EQ(constrained_edges(t), Edges{edge(0, 1)});
}

TEST(PlanarConstraint, ReportsThatItLeavesTheTriangulation) {
  // An L: the straight way from one end to the other is outside.
  const IntegerPlane plane{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}};
  planar::Triangulation t =
      planar::from_triangles(Triangles{triangle(0, 1, 3), triangle(1, 2, 3), triangle(0, 3, 5), triangle(3, 4, 5)});
  EXPECT_FALSE(planar::insert_constraint(t, VertexId(2u), VertexId(4u), plane).inserted);
  EXPECT_FALSE(planar::insert_constraint(t, VertexId(1u), VertexId(4u), plane).inserted);
  expect_sound(t, plane);
}

TEST(PlanarConstraint, KeepsAConstrainedSpikeThatReachesIntoItsChannel) {
  // The way from 0 to 1 passes under the spike 2-3, through the triangles on both its sides.
  const IntegerPlane plane{{{0, 0}, {1000, 0}, {500, 600}, {500, 3}, {400, -50}, {600, -50}}};
  planar::Triangulation t = triangulate(plane, {edge(2, 3)}).triangulation;
  const auto spike = planar::find_edge(t, VertexId(2u), VertexId(3u));
  ASSERT_TRUE(spike);
  for (const planar::Side& side : {*spike, *side_across(t, *spike)}) {
    ASSERT_LT(plane.orient(VertexId(0u), VertexId(1u), t.triangles[side.triangle][side.corner]), 0);
  }
  ASSERT_TRUE(planar::insert_constraint(t, VertexId(0u), VertexId(1u), plane).inserted);
  EXPECT_EQ(constrained_edges(t), (Edges{edge(0, 1), edge(2, 3)}));
  expect_sound(t, plane);
  expect_locally_delaunay(t, plane);
}

/// Random edges, without those that cross earlier ones.
Edges random_constraints(const IntegerPlane& plane, std::size_t tries, std::mt19937& random) {
  planar::Triangulation t = triangulate(plane, {}).triangulation;
  const std::int64_t area = twice_area(t, plane);
  Edges inserted;
  for (std::size_t i = 0; i < tries; ++i) {
    const VertexId a(random() % plane.points.size()), b(random() % plane.points.size());
    if (a == b) continue;
    const auto result = planar::insert_constraint(t, a, b, plane);
    for (const auto& [from, to] : result.parts) EXPECT_TRUE(has_constrained(t, from, to));
    inserted.insert(inserted.end(), result.parts.begin(), result.parts.end());
    if (!result.inserted) {
      EXPECT_TRUE(has_constrained(t, result.obstacle[0], result.obstacle[1]));
    } else {
      EXPECT_EQ(result.parts.back()[1], b);
    }
  }
  expect_sound(t, plane);
  expect_locally_delaunay(t, plane);
  EXPECT_EQ(twice_area(t, plane), area);
  return inserted;
}

TEST(PlanarConstraint, GivesAUniqueTriangulationInAnyOrder) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const IntegerPlane plane = random_points(80, seed % 2 == 0 ? 12 : 10000, seed);
    Edges edges = random_constraints(plane, 60, random);
    const Triangles first = canonical(triangulate(plane, edges).triangulation);
    for (int round = 0; round < 3; ++round) {
      std::shuffle(edges.begin(), edges.end(), random);
      for (planar::Edge& e : edges) {
        if (random() % 2 == 0) std::swap(e[0], e[1]);
      }
      EXPECT_EQ(canonical(triangulate(plane, edges).triangulation), first);
    }
  }
}

TEST(PlanarConstraint, MayCrossThousandsOfEdges) {
  IntegerPlane plane = random_points(20000, 1 << 20, 7);
  plane.points.push_back({-10, 1 << 19});
  plane.points.push_back({(1 << 20) + 10, (1 << 19) + 1});
  planar::Triangulation t = triangulate(plane, {}).triangulation;
  const std::int64_t area = twice_area(t, plane);
  ASSERT_TRUE(planar::insert_constraint(t, VertexId(20000u), VertexId(20001u), plane).inserted);
  EXPECT_EQ(twice_area(t, plane), area);
  expect_locally_delaunay(t, plane);
}

// ---- Polygons -------------------------------------------------------------------------------------------------------

TEST(PlanarTriangulate, TellsWhichEdgesCross) {
  const IntegerPlane plane{{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {4, 0}}};
  const auto result = triangulate(plane, {edge(0, 1), edge(1, 2), edge(2, 0), edge(4, 3)});
  EXPECT_EQ(result.status, Status::crossing);
  EXPECT_EQ(result.crossing, (std::array<std::size_t, 2>{2, 3}));
  EXPECT_TRUE(result.triangulation.triangles.empty());
}

TEST(PlanarTriangulate, RejectsAnEdgeWithAnUnknownEnd) {
  const IntegerPlane plane{{{0, 0}, {8, 0}, {8, 8}, {4, 4}}};
  const auto three = std::vector{VertexId(0u), VertexId(1u), VertexId(2u)};
  EXPECT_THROW(planar::triangulate<IntegerPlane>(three, Edges{edge(0, 3)}, plane), std::invalid_argument);
}

TEST(PlanarTriangulate, RemovesWhatIsOutsideOfAConcavePolygon) {
  IntegerPlane plane;
  Edges edges;
  add_polygon(plane, edges, {{0, 0}, {9, 0}, {9, 9}, {5, 2}, {0, 9}});
  plane.points.push_back({5, 8});
  const auto result = triangulate(plane, edges, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result.triangulation.triangles.size(), 3u);
  EXPECT_EQ(planar::border_edges(result.triangulation), constrained_edges(result.triangulation));
  EXPECT_EQ(result.unused, std::vector{VertexId(5u)});
  EXPECT_EQ(twice_area(result.triangulation, plane), 2 * 81 - 9 * 7);
  expect_sound(result.triangulation, plane);
}

TEST(PlanarTriangulate, CutsHolesBySeedsOrByNesting) {
  IntegerPlane plane;
  Edges edges;
  add_polygon(plane, edges, square(0, 20));
  add_polygon(plane, edges, square(4, 16));
  add_polygon(plane, edges, square(8, 12));
  const auto area = [&](const planar::Carving& carving) {
    IntegerPlane with_seeds = plane;
    with_seeds.points.insert(with_seeds.points.end(), {{6, 6}, {10, 9}, {30, 1}});
    const auto result = planar::triangulate<IntegerPlane>(all_vertices(plane), edges, with_seeds, carving);
    EXPECT_TRUE(result);
    EXPECT_EQ(result.lost_seeds.size(), static_cast<std::size_t>(std::count(carving.hole_seeds.begin(),
                                                                            carving.hole_seeds.end(), VertexId(14u))));
    expect_sound(result.triangulation, with_seeds);
    return twice_area(result.triangulation, with_seeds) / 2;
  };
  EXPECT_EQ(area({}), 400);
  EXPECT_EQ(area({true, {}}), 400 - 144 + 16);
  EXPECT_EQ(area({false, {VertexId(12u)}}), 400 - 144 + 16);
  EXPECT_EQ(area({false, {VertexId(13u)}}), 400 - 16);
  EXPECT_EQ(area({false, {VertexId(12u), VertexId(13u), VertexId(14u)}}), 400 - 144);
}

TEST(PlanarTriangulate, KeepsSlitsAndDanglingEdgesWithinAPolygon) {
  IntegerPlane plane;
  Edges edges;
  add_polygon(plane, edges, square(0, 20));
  plane.points.insert(plane.points.end(), {{10, 10}, {15, 12}, {3, 4}});
  edges.insert(edges.end(), {edge(0, 4), edge(4, 5), edge(6, 6)});
  for (const bool nested : {false, true}) {
    const auto result = triangulate(plane, edges, {nested, {}});
    ASSERT_TRUE(result);
    EXPECT_EQ(twice_area(result.triangulation, plane), 800);
    EXPECT_TRUE(has_constrained(result.triangulation, VertexId(0u), VertexId(4u)));
    EXPECT_TRUE(has_constrained(result.triangulation, VertexId(4u), VertexId(5u)));
    EXPECT_TRUE(result.unused.empty());
  }
}

TEST(PlanarTriangulate, AcceptsPolygonsThatTouchInACorner) {
  IntegerPlane plane;
  Edges edges;
  add_polygon(plane, edges, square(0, 4));
  plane.points.insert(plane.points.end(), {{8, 4}, {8, 8}, {4, 8}});
  edges.insert(edges.end(), {edge(2, 4), edge(4, 5), edge(5, 6), edge(6, 2)});
  auto result = triangulate(plane, edges, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(twice_area(result.triangulation, plane), 64);
  // The pinched vertex has two fans: constraints must find theirs.
  for (const auto& [from, to] : {std::pair{0u, 2u}, {2u, 5u}}) {
    EXPECT_TRUE(planar::insert_constraint(result.triangulation, VertexId(from), VertexId(to), plane).inserted);
    EXPECT_TRUE(has_constrained(result.triangulation, VertexId(from), VertexId(to)));
  }
  expect_sound(result.triangulation, plane);
}

TEST(PlanarTriangulate, LeavesNothingOfEdgesThatEncloseNothing) {
  const IntegerPlane plane{{{0, 0}, {8, 0}, {8, 8}, {3, 9}}};
  const auto result = triangulate(plane, {edge(0, 1), edge(1, 2)}, {});
  ASSERT_TRUE(result);
  EXPECT_TRUE(result.triangulation.triangles.empty());
  EXPECT_EQ(result.unused.size(), 4u);
}

}  // namespace
}  // namespace ccdt
