#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "engine/base/errors.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

using Polygon = std::vector<std::uint32_t>;

plc::PolygonFacet facet(std::vector<Polygon> polygons, std::uint32_t number) {
  plc::PolygonFacet f;
  f.polygons = std::move(polygons);
  f.number = number;
  return f;
}

/// A box of six squares.
plc::InputPlc polygon_cube(double size = 1) {
  plc::InputPlc plc;
  plc.name = "cube of squares";
  plc.inside = plc::InputPlc::Inside::seeds;
  plc.vertices = box({0, 0, 0}, {size, size, size}).vertices;
  for (const Polygon& q :
       std::vector<Polygon>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    plc.polygon_facets.push_back(facet({q}, static_cast<std::uint32_t>(plc.polygon_facets.size())));
  return plc;
}

/// A cube of size 4 with a square hole of size 2 from bottom to top.
plc::InputPlc cube_with_through_hole() {
  plc::InputPlc plc = polygon_cube(4);
  for (const double z : {0.0, 4.0})
    for (const auto& [x, y] : {std::pair{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {1.0, 3.0}})
      plc.vertices.push_back({x, y, z});
  plc.polygon_facets[0].polygons.push_back({8, 9, 10, 11});
  plc.polygon_facets[0].holes = {{2, 2.5, 0}};
  plc.polygon_facets[1].polygons.push_back({12, 13, 14, 15});
  plc.polygon_facets[1].holes = {{2, 2.5, 4}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t l = (k + 1) % 4;
    plc.polygon_facets.push_back(facet({{8 + k, 8 + l, 12 + l, 12 + k}}, 6 + k));
  }
  return plc;
}

plc::InputPlc turned(const Matrix& m, const plc::InputPlc& plc) {
  plc::InputPlc result = rotated(m, plc);
  for (plc::PolygonFacet& f : result.polygon_facets)
    for (Point3& hole : f.holes) hole = rotated(m, hole);
  return result;
}

/// Expects an error with a remedy at these facets.
void expect_rejected(const plc::InputPlc& input, const std::vector<long long>& facets) {
  try {
    plc::build_plc(input);
    ADD_FAILURE() << "not rejected";
  } catch (const InputError& error) {
    EXPECT_FALSE(error.remedy().empty());
    EXPECT_EQ(error.place().facets, facets) << error.what();
  }
}

TEST(PlcPolygons, ACubeOfSquares) {
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(turned(m, polygon_cube()));
    EXPECT_EQ(plc.facets.size(), 6u);
    EXPECT_EQ(plc.segments.size(), 12u);
    EXPECT_NEAR(inside_volume(plc), 1, 1e-9);
    for (const plc::Facet& f : plc.facets) EXPECT_EQ(f.triangle_count, 2u);
  }
}

TEST(PlcPolygons, AThroughHole) {
  for (const Matrix& m : {rotation(1, 0, 0, 0), arbitrary}) {
    const plc::Plc plc = plc::build_plc(turned(m, cube_with_through_hole()));
    EXPECT_EQ(plc.facets.size(), 10u);
    EXPECT_EQ(plc.segments.size(), 24u);
    EXPECT_EQ(grazeable_count(plc), 4u) << "the four upright edges of the hole";
    EXPECT_EQ(inside_count(plc), 1u);
    EXPECT_NEAR(inside_volume(plc), 64 - 16, 1e-6);
    EXPECT_EQ(plc.facets[0].triangle_count, 8u);
  }
}

TEST(PlcPolygons, AConcavePolygon) {
  const plc::InputPlc l = l_shape();
  plc::InputPlc plc = l;
  plc.triangles.clear();
  Polygon bottom, top;
  for (std::uint32_t k = 0; k < 6; ++k) {
    bottom.push_back(5 - k);
    top.push_back(6 + k);
    plc.polygon_facets.push_back(facet({{k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k}}, k));
  }
  plc.polygon_facets.push_back(facet({bottom}, 6));
  plc.polygon_facets.push_back(facet({top}, 7));
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 8u);
  EXPECT_EQ(segment_ends(built), segment_ends(plc::build_plc(l)));
  EXPECT_NEAR(inside_volume(built), 3, 1e-12);
}

TEST(PlcPolygons, SegmentsAndVerticesWithinAFacet) {
  plc::InputPlc plc = polygon_cube(4);
  plc.vertices.insert(plc.vertices.end(), {{1, 2, 4}, {3, 2, 4}, {2, 3, 4}});
  plc.polygon_facets[1].polygons.push_back({8, 9});
  plc.polygon_facets[1].polygons.push_back({10});
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(built.segments.size(), 13u);
  EXPECT_EQ(segment_ends(built, true), (std::set<std::array<std::uint32_t, 2>>{{8, 9}}));
  std::set<std::uint32_t> corners;
  for (const auto& t : built.triangles_of(built.facets[1])) corners.insert(t.begin(), t.end());
  EXPECT_EQ(corners, (std::set<std::uint32_t>{4, 5, 6, 7, 8, 9, 10}));
}

TEST(PlcPolygons, ALoopWithinAFacetThatIsNoHoleDividesIt) {
  plc::InputPlc plc = polygon_cube(4);
  plc.vertices.insert(plc.vertices.end(), {{1, 1, 4}, {3, 1, 4}, {2, 3, 4}});
  plc.polygon_facets[1].polygons.push_back({8, 9, 10});
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 7u);
  EXPECT_EQ(built.segments.size(), 15u);
  EXPECT_EQ(built.regions.size(), 2u);
}

TEST(PlcPolygons, AGivenSegmentAcrossAFacetBecomesAnEdgeOfIt) {
  for (const std::array<std::uint32_t, 2>& diagonal : {std::array{4u, 7u}, std::array{5u, 6u}}) {
    plc::InputPlc plc = polygon_cube();
    plc.segments = {diagonal};
    plc.segment_markers = {3};
    const plc::Plc built = plc::build_plc(plc);
    EXPECT_EQ(built.segments.size(), 13u);
    EXPECT_EQ(segment_ends(built).count(diagonal), 1u);
    EXPECT_EQ(built.facets.size(), 7u);
  }
}

TEST(PlcPolygons, AVertexOnAnEdgeOfNeighborsThatDoNotNameIt) {
  plc::InputPlc plc = polygon_cube(4);
  plc.vertices.push_back({2, 0, 4});
  plc.polygon_facets[1].polygons[0] = {4, 8, 5, 7, 6};  // the side facet has the whole edge
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(built.segments.size(), 13u);
  EXPECT_NEAR(inside_volume(built), 64, 1e-9);
}

TEST(PlcPolygons, AFacetOfTwoVerticesIsADanglingSegment) {
  plc::InputPlc plc = polygon_cube(4);
  plc.vertices.insert(plc.vertices.end(), {{1, 1, 1}, {2, 3, 2}});
  plc.polygon_facets.push_back(facet({{8, 9}}, 6));
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(segment_ends(built, true), (std::set<std::array<std::uint32_t, 2>>{{8, 9}}));
}

TEST(PlcPolygons, AFacetWithoutAreaIsLeftOutButNotItsVertices) {
  plc::InputPlc plc = polygon_cube();
  plc.vertices.insert(plc.vertices.end(), {{0.25, 0, 0}, {0.5, 0, 0}});
  plc.polygon_facets.push_back(facet({{0, 8, 9, 1}}, 6));
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(built.segments.size(), 14u);
}

TEST(PlcPolygons, APolygonIsPlanarHoweverSmallTheToleranceOfFacets) {
  const plc::Plc plc = plc::build_plc(turned(arbitrary, polygon_cube()), {.flatness = 0});
  EXPECT_NEAR(inside_volume(plc), 1, 1e-9);
}

TEST(PlcPolygons, APolygonThatRunsRoundSeveralTimesIsOneFacet) {
  plc::InputPlc plc = polygon_cube();
  Polygon& polygon = plc.polygon_facets[0].polygons[0];
  const Polygon once = polygon;
  for (int i = 0; i < 3; ++i) polygon.insert(polygon.end(), once.begin(), once.end());
  const plc::Plc built = plc::build_plc(plc);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(built.segments.size(), 12u);
  EXPECT_NEAR(inside_volume(built), 1, 1e-12);
}

TEST(PlcPolygons, BadFacetsAreRejected) {
  plc::InputPlc plc = polygon_cube();
  plc.vertices[7].z = 1.001;
  expect_rejected(plc, {1});

  plc = polygon_cube();
  std::swap(plc.polygon_facets[2].polygons[0][0], plc.polygon_facets[2].polygons[0][1]);
  expect_rejected(plc, {2});

  plc = polygon_cube();
  plc.polygon_facets[0].holes = {{0.5, 7, 0}};
  expect_rejected(plc, {0});

  plc = polygon_cube();
  plc.vertices.push_back({3, 0.5, 1});
  plc.polygon_facets[1].polygons.push_back({8});
  expect_rejected(plc, {1});

  plc = polygon_cube();
  plc.polygon_facets[1].polygons = {{4, 5}, {5, 7}, {7, 6}};
  expect_rejected(plc, {1});

  plc = polygon_cube();
  plc.polygon_facets.push_back(facet({{0, 2, 3, 1}}, 6));
  expect_rejected(plc, {0, 6});

  plc = polygon_cube();
  plc.polygon_facets.pop_back();
  expect_rejected(plc, {});
}

}  // namespace
}  // namespace ccdt
