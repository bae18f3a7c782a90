#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "models/solids.h"
#include "models/tests/surface_checks.h"

namespace ccdt::testing {
namespace {

void expect_closed_surface_of_a_ball(const plc::InputPlc& input) {
  for (const EdgeUse& edge : edges_of(input.triangles)) {
    ASSERT_EQ(edge.forwards, 1);
    ASSERT_EQ(edge.backwards, 1);
  }
  EXPECT_EQ(euler_characteristic(input.triangles), 2);
  std::set<std::array<double, 3>> places;
  for (const Point3& p : input.vertices) EXPECT_TRUE(places.insert({p.x, p.y, p.z}).second);
  std::set<std::uint32_t> used;
  for (const auto& t : input.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(used.size(), input.vertices.size());
  const std::set<int> markers(input.triangle_markers.begin(), input.triangle_markers.end());
  EXPECT_EQ(*markers.begin(), 1);
  EXPECT_EQ(*markers.rbegin(), static_cast<int>(markers.size()));
}

void expect_same_each_time(std::string_view name, double edge_length) {
  const plc::InputPlc input = models::make_solid(name, edge_length), again = models::make_solid(name, edge_length);
  EXPECT_EQ(input.vertices, again.vertices);
  EXPECT_EQ(input.triangles, again.triangles);
  EXPECT_EQ(input.triangle_markers, again.triangle_markers);
}

double ratio_of_edges(const plc::InputPlc& input) {
  const std::vector<double> lengths = edge_lengths(input);
  return *std::ranges::max_element(lengths) / *std::ranges::min_element(lengths);
}

TEST(GradedCube, IsAClosedSurfaceAroundAUnitOfVolume) {
  for (const double edge_length : {0.5, 0.25, 1.0 / 6, 0.07}) {
    const plc::InputPlc input = models::make_solid("graded-cube", edge_length);
    expect_closed_surface_of_a_ball(input);
    EXPECT_NEAR(enclosed_volume(input.vertices, input.triangles), 1, 1e-12) << edge_length;
  }
}

TEST(GradedCube, EdgesDifferByAFactorOfMoreThanAHundredAtEveryDensity) {
  for (const double edge_length : {0.5, 0.2, 0.0625})
    EXPECT_NEAR(ratio_of_edges(models::make_solid("graded-cube", edge_length)), 128 * std::sqrt(2), 1e-9)
        << edge_length;
}

TEST(GradedCube, EdgesShrinkTowardsTheOrigin) {
  const plc::InputPlc input = models::make_solid("graded-cube", 0.125);
  for (const EdgeUse& edge : edges_of(input.triangles)) {
    const Point3 &a = input.vertices[edge.ends[0]], &b = input.vertices[edge.ends[1]];
    const double far = std::max({a.x, a.y, a.z, b.x, b.y, b.z}), length = std::sqrt(squared_length(b - a));
    // A block has four squares along its side and is its side away from the origin; the last one is at the origin.
    EXPECT_LE(length, std::sqrt(2) * std::max(far, 1.0 / 256) / 4);
  }
}

TEST(GradedCube, LargestSquaresHaveTheEdgeLength) {
  const std::vector<double> lengths = edge_lengths(models::make_solid("graded-cube", 0.125));
  EXPECT_DOUBLE_EQ(*std::ranges::max_element(lengths), 0.125 * std::sqrt(2));
}

TEST(GradedCube, TrianglesAreHalvesOfSquaresOrThirdsOfThem) {
  const std::vector<double> angles = smallest_angles(models::make_solid("graded-cube", 0.1));
  EXPECT_GT(*std::ranges::min_element(angles), 26.56);  // the arc tangent of 1/2
  EXPECT_NEAR(quantile(angles, 0.5), 45, 1e-9);
}

TEST(GradedCube, IsTheSameEachTime) {
  expect_same_each_time("graded-cube", 0.25);
}

TEST(RoughSphere, IsAClosedSurfaceThatEveryRayFromTheCenterMeetsOnce) {
  for (const double edge_length : {1.2, 0.3, 0.05}) {
    const plc::InputPlc input = models::make_solid("rough-sphere", edge_length);
    expect_closed_surface_of_a_ball(input);
    for (const auto& [a, b, c] : input.triangles)
      EXPECT_GT(dot(input.vertices[a], cross(input.vertices[b], input.vertices[c])), 0);
  }
}

TEST(RoughSphere, RadiiFillTheWholeRangeEvenly) {
  const plc::InputPlc input = models::make_solid("rough-sphere", 0.1);
  std::vector<double> logarithms;
  for (const Point3& p : input.vertices) logarithms.push_back(std::log(squared_length(p)) / 2);
  EXPECT_GE(quantile(logarithms, 0), -0.15 - 1e-12);
  EXPECT_LE(quantile(logarithms, 1), 0.15 + 1e-12);
  EXPECT_NEAR(quantile(logarithms, 0.1), -0.12, 0.01);
  EXPECT_NEAR(quantile(logarithms, 0.5), 0, 0.01);
  EXPECT_NEAR(quantile(logarithms, 0.9), 0.12, 0.01);
}

TEST(RoughSphere, IsTheSameEachTime) {
  expect_same_each_time("rough-sphere", 0.2);
}

}  // namespace
}  // namespace ccdt::testing
