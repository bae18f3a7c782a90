#include "models/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "models/revolve.h"
#include "models/tests/surface_checks.h"

namespace ccdt::testing {
namespace {

models::Chain rectangle(models::ModelSurface& surface, double width, double height, double spacing) {
  const std::array<Point3, 4> p{{{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}};
  std::array<models::Chain, 4> sides;
  for (std::size_t i = 0; i < 4; ++i) sides[i] = models::line(surface, p[i], p[(i + 1) % 4], spacing);
  return models::closed_loop(sides);
}

double area(const models::ModelSurface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const Point3 normal = cross(surface.vertices[b] - surface.vertices[a], surface.vertices[c] - surface.vertices[a]);
    sum += normal.z / 2;  // negative if it is turned over
  }
  return sum;
}

TEST(Curves, EndInTheSameVertexWhereTheyMeet) {
  models::ModelSurface surface;
  const models::Chain round = models::arc(surface, models::Axis::z, {10, 0, 0}, 2, 0, 90, 0.5);
  const models::Chain straight = models::line(surface, {10, 2, 0}, {0, 2, 0}, 0.5);
  EXPECT_EQ(round.back(), straight.front());
}

TEST(Curves, AreCutIntoEqualParts) {
  models::ModelSurface surface;
  const auto ellipse = [](double t) { return Point3{10 * models::cosine(180 * t), 4 * models::sine(180 * t), 0}; };
  const models::Chain chain = models::curve(surface, ellipse(0), ellipse(1), ellipse, 0.2, 1);
  double shortest = 1e9, longest = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const double length = models::distance(surface.vertices[chain[i]], surface.vertices[chain[i + 1]]);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  EXPECT_LT(longest, 1.02 * shortest);
  EXPECT_NEAR(longest, 0.2, 0.01);
}

TEST(Curves, ThatDoNotMeetMakeNoLoop) {
  models::ModelSurface surface;
  const std::array chains{models::line(surface, {0, 0, 0}, {1, 0, 0}, 1),
                          models::line(surface, {1, 1, 0}, {0, 0, 0}, 1)};
  EXPECT_THROW(models::closed_loop(chains), std::logic_error);
}

TEST(Charts, LiftIsTheInverseOfFlatten) {
  const models::Chart chart =
      models::cylinder_chart(models::Axis::x, {1, 2, 3}, 4, 120, models::OuterSide::towards_axis);
  const Point3 p = models::on_circle(models::Axis::x, {7, 2, 3}, 4, 75);
  const Point3 q = chart.lift(chart.flatten(p));
  EXPECT_NEAR(models::distance(p, q), 0, 1e-13);
}

TEST(SurfacePatch, CoversARectangleWithAHoleAndKeepsItsEdges) {
  models::ModelSurface surface;
  const models::Chain outer = rectangle(surface, 20, 12, 1);
  const models::Ring hole = models::ring(surface, models::Axis::z, {8, 6, 0}, 3, 0, 1);
  const std::size_t border_vertices = surface.vertices.size();
  models::add_patch(surface, {models::plane_chart({}, {0, 0, 1}), {outer, hole.chain}, {}, 1, 7});
  const auto edges = static_cast<double>(hole.chain.size());
  const double polygon = edges / 2 * 9 * std::sin(2 * std::numbers::pi / edges);
  EXPECT_NEAR(area(surface), 240 - polygon, 1e-9);
  std::size_t border = 0;
  for (const EdgeUse& edge : edges_of(surface.triangles)) border += edge.forwards + edge.backwards == 1;
  EXPECT_EQ(border, border_vertices);
  for (const int marker : surface.markers) EXPECT_EQ(marker, 7);
}

TEST(SurfacePatch, HasTheEdgesOfACutInside) {
  models::ModelSurface surface;
  const std::array<Point3, 5> p{{{0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {10, 10, 0}, {0, 10, 0}}};
  std::array<models::Chain, 5> sides;
  for (std::size_t i = 0; i < 5; ++i) sides[i] = models::line(surface, p[i], p[(i + 1) % 5], 1);
  const models::Chain outer = models::closed_loop(sides);
  const models::Chain cut = models::line(surface, p[2], {4, 5, 0}, 1);
  models::add_patch(surface, {models::plane_chart({}, {0, 0, 1}), {outer}, {cut}, 1, 1});
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const EdgeUse& edge : edges_of(surface.triangles)) edges.insert(edge.ends);
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    EXPECT_TRUE(edges.contains({std::min(cut[i], cut[i + 1]), std::max(cut[i], cut[i + 1])}));
  }
  EXPECT_NEAR(area(surface), 100, 1e-9);
}

TEST(SurfacePatch, IsFinerNearAFineCurveAndGrowsAwayFromIt) {
  models::ModelSurface surface;
  const models::Chain outer = rectangle(surface, 40, 40, 4);
  const models::Ring hole = models::ring(surface, models::Axis::z, {20, 20, 0}, 1, 0, 4);
  models::add_patch(surface, {models::plane_chart({}, {0, 0, 1}), {outer, hole.chain}, {}, 4, 1});
  plc::InputPlc input;
  input.vertices = surface.vertices;
  input.triangles = surface.triangles;
  EXPECT_GT(quantile(smallest_angles(input), 0), 25);
}

TEST(SurfacePatch, WhoseCurvesCrossIsRefused) {
  for (const double x : {10.0, 9.5}) {  // at vertices of one of them, and away from all vertices
    models::ModelSurface surface;
    const models::Chain outer = rectangle(surface, 10, 10, 1);
    const models::Ring hole = models::ring(surface, models::Axis::z, {x, 5.3, 0}, 2, 0, 1);
    EXPECT_THROW(models::add_patch(surface, {models::plane_chart({}, {0, 0, 1}), {outer, hole.chain}, {}, 1, 1}),
                 std::logic_error);
  }
}

TEST(Revolution, JoinsRingsOfDifferentCountsWithoutAGap) {
  models::ModelSurface surface;
  const models::Ring coarse = models::ring(surface, models::Axis::z, {}, 10, 0, 2),
                     fine = models::ring(surface, models::Axis::z, {}, 10, 8, 0.7);
  models::add_cone(surface, coarse, fine, {models::Axis::z, {}, 2, 1});
  std::size_t border = 0;
  for (const EdgeUse& edge : edges_of(surface.triangles)) {
    EXPECT_LE(edge.forwards, 1);
    EXPECT_LE(edge.backwards, 1);
    border += edge.forwards + edge.backwards == 1;
  }
  EXPECT_EQ(border, coarse.chain.size() + fine.chain.size());
}

}  // namespace
}  // namespace ccdt::testing
