#include "engine/plc/warped_facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "engine/base/simplex_map.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

using Polygon = std::vector<std::uint32_t>;

/// One facet alone, in the order of its vertices.
plc::InputPlc polygon(const std::vector<Point3>& corners) {
  plc::InputPlc plc;
  plc.vertices = corners;
  plc.polygon_facets.resize(1);
  plc.polygon_facets[0].polygons.resize(1);
  for (std::uint32_t i = 0; i < corners.size(); ++i) plc.polygon_facets[0].polygons[0].push_back(i);
  return plc;
}

Point3 unit_normal(const plc::InputPlc& plc, const Triangle& t) {
  return normalized(area_vector({plc.vertices[t[0]], plc.vertices[t[1]], plc.vertices[t[2]]}));
}

/// \return  whether there were any
bool triangulate_warped_facets(plc::InputPlc& plc) {
  auto triangulated = plc::triangulate_warped_facets(plc);
  if (triangulated) plc = *triangulated;
  return triangulated.has_value();
}

/// The largest angle between neighboring triangles.
double bend_of(const plc::InputPlc& plc, const std::vector<Triangle>& triangles) {
  double largest = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto is_shared = [&](std::uint32_t v) { return std::ranges::count(triangles[j], v) > 0; };
      if (std::ranges::count_if(triangles[i], is_shared) != 2) continue;
      const Point3 m = unit_normal(plc, triangles[i]), n = unit_normal(plc, triangles[j]);
      largest = std::max(largest, std::atan2(length(cross(m, n)), dot(m, n)));
    }
  return largest;
}

/// All triangulations of the corners from i to j.
std::vector<std::vector<Triangle>> all_triangulations(std::uint32_t i, std::uint32_t j) {
  if (j == i + 1) return {{}};
  std::vector<std::vector<Triangle>> all;
  for (std::uint32_t k = i + 1; k < j; ++k)
    for (const auto& left : all_triangulations(i, k))
      for (const auto& right : all_triangulations(k, j)) {
        std::vector<Triangle> both = left;
        both.insert(both.end(), right.begin(), right.end());
        both.push_back({i, k, j});
        all.push_back(both);
      }
  return all;
}

double projected_area(const plc::InputPlc& plc) {
  double sum = 0;
  for (const auto& [a, b, c] : plc.triangles) {
    const double area = 0.5 * area_vector({plc.vertices[a], plc.vertices[b], plc.vertices[c]}).z;
    EXPECT_GT(area, 0) << "a triangle is folded over";
    sum += area;
  }
  return sum;
}

TEST(WarpedFacets, NoTriangulationBendsLess) {
  std::mt19937 random(1);
  const auto noise = [&](double size) { return size * (static_cast<double>(random() % 2001) / 1000 - 1); };
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::uint32_t n = 4 + i % 5;
    std::vector<Point3> corners;
    for (std::uint32_t k = 0; k < n; ++k)
      corners.push_back(
          {std::cos(2 * portable::pi * k / n), std::sin(2 * portable::pi * k / n), noise(i % 2 ? 0.3 : 1e-6)});
    plc::InputPlc plc = polygon(corners);
    double least = 10;
    for (const auto& triangles : all_triangulations(0, n - 1)) least = std::min(least, bend_of(plc, triangles));
    triangulate_warped_facets(plc);
    ASSERT_EQ(plc.triangles.size(), n - 2);
    EXPECT_NEAR(bend_of(plc, plc.triangles) / least, 1, 1e-3) << n << " corners";
  }
}

TEST(WarpedFacets, TheDeviationIsTheDistanceFromThePlaneInTheMiddle) {
  plc::InputPlc plc = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.02}, {0, 1, 0}});
  plc.polygon_facets[0].marker = 7;
  plc.polygon_facets[0].number = 3;
  triangulate_warped_facets(plc);
  EXPECT_EQ(plc.warped.count, 1u);
  EXPECT_NEAR(plc.warped.largest_deviation, 0.01, 1e-4);
  EXPECT_TRUE(plc.polygon_facets.empty());
  EXPECT_EQ(plc.triangle_markers, (std::vector<int>{7, 7}));
  EXPECT_EQ(plc.triangle_numbers, (std::vector<std::uint32_t>{3, 3}));
}

TEST(WarpedFacets, PolygonsThatAreFlatWithinTheToleranceStay) {
  plc::InputPlc plc = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-8}, {0, 1, 0}});
  EXPECT_FALSE(triangulate_warped_facets(plc));
}

TEST(WarpedFacets, APolygonWithTheSameCornersAsTwoTrianglesTakesTheOtherDiagonal) {
  plc::InputPlc plc = polygon({{0, 0, 0}, {3, 0, 0}, {3, 1, 0.5}, {0, 1, 0}});
  triangulate_warped_facets(plc);
  const std::vector<Triangle> alone = plc.triangles;
  plc = polygon(plc.vertices);
  plc.triangles = alone;
  triangulate_warped_facets(plc);
  ASSERT_EQ(plc.triangles.size(), 4u);
  std::set<FaceKey> different;
  for (const auto& [a, b, c] : plc.triangles) different.insert(face_key(a, b, c));
  EXPECT_EQ(different.size(), 4u);
  EXPECT_EQ(plc::build_plc(plc).facets.size(), 4u);
}

TEST(WarpedFacets, ConcavePolygonsWithStraightSidesDoNotFold) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    std::vector<Point3> corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1.5, 1, 0},
                                   {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0.5, 0}};
    for (Point3& p : corners)
      for (double* x : {&p.x, &p.y, &p.z}) *x += 1e-6 * (static_cast<double>(random() % 2001) / 1000 - 1);
    plc::InputPlc plc = polygon(corners);
    triangulate_warped_facets(plc);
    ASSERT_EQ(plc.triangles.size(), 8u);
    EXPECT_NEAR(projected_area(plc), 3, 1e-4);
    EXPECT_LT(bend_of(plc, plc.triangles), 1e-3);
  }
}

TEST(WarpedFacets, CornersAtTheSamePlaceAreOne) {
  plc::InputPlc plc = polygon({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}, {0, 0, 0}});
  triangulate_warped_facets(plc);
  EXPECT_EQ(plc.triangles.size(), 2u);
}

TEST(WarpedFacets, ManyCornersAndHolesAreTriangulatedToo) {
  plc::InputPlc plc;
  for (const double radius : {2.0, 1.0})
    for (int k = 0; k < 100; ++k)
      plc.vertices.push_back(
          {radius * std::cos(0.02 * portable::pi * k), radius * std::sin(0.02 * portable::pi * k), 1e-6 * (k % 7)});
  Polygon outer(100), inner(100);
  for (std::uint32_t k = 0; k < 100; ++k) inner[k] = 100 + (outer[k] = k);
  plc.polygon_facets.resize(2);
  plc.polygon_facets[0].polygons = {outer, inner};
  plc.polygon_facets[0].holes = {{0, 0, 0}};
  plc.polygon_facets[1].polygons = {inner};
  triangulate_warped_facets(plc);
  EXPECT_EQ(plc.warped.count, 2u);
  EXPECT_EQ(plc.triangles.size(), 200u + 98u);
  EXPECT_NEAR(projected_area(plc), 4 * portable::pi, 0.01);
}

TEST(WarpedFacets, ABoxWithOneCornerMovedIsAClosedSurface) {
  plc::InputPlc plc;
  plc.vertices = box({0, 0, 0}, {1, 1, 1}).vertices;
  plc.vertices[7] = {1.1, 1.1, 1.2};
  for (const Polygon& q :
       std::vector<Polygon>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    plc.polygon_facets.push_back({{q}, {}, 0, static_cast<std::uint32_t>(plc.polygon_facets.size())});
  triangulate_warped_facets(plc);
  EXPECT_EQ(plc.warped.count, 3u);
  EXPECT_EQ(plc.polygon_facets.size(), 3u);
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 9u);
  EXPECT_EQ(built.regions.size(), 2u);
}

}  // namespace
}  // namespace ccdt
