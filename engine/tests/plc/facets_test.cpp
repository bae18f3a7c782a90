#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "engine/base/flatness.h"
#include "engine/geometry/predicates.h"
#include "engine/tests/shared/plc_test_solids.h"

namespace ccdt {
namespace {

using namespace plc_test;

void expect_valid(const plc::Plc& plc) {
  std::set<std::array<std::uint32_t, 2>> ends = segment_ends(plc);
  EXPECT_EQ(ends.size(), plc.segments.size()) << "a segment is there twice";
  for (const plc::Facet& f : plc.facets) {
    std::map<std::array<std::uint32_t, 2>, int> edges;
    for (const auto& t : plc.triangles_of(f))
      for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
      const bool is_segment = ends.count({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}) > 0;
      EXPECT_TRUE(is_segment || (count == 1 && edges.count({edge[1], edge[0]}) == 1))
          << "an inner edge of a facet without two triangles of one orientation";
    }
  }
}

TEST(PlcFacets, CubeHasSixFacetsTwelveSegmentsAndNothingGrazeable) {
  const plc::Plc plc = plc::build_plc(unit_cube());
  expect_valid(plc);
  EXPECT_EQ(plc.vertices.size(), 8u);
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 12u);
  EXPECT_EQ(grazeable_count(plc), 0u);
  EXPECT_EQ(plc.regions.size(), 2u);
  EXPECT_FALSE(plc.regions[0].inside);
  EXPECT_TRUE(plc.regions[1].inside);
  for (const plc::Facet& f : plc.facets) {
    EXPECT_TRUE(f.exactly_flat);
    EXPECT_EQ(f.above, 0u);
    EXPECT_EQ(f.below, 1u);
  }
  EXPECT_DOUBLE_EQ(inside_volume(plc), 1.0);
}

TEST(PlcFacets, OrientationOfTheInputDoesNotMatter) {
  plc::InputPlc cube = unit_cube();
  for (std::size_t t = 0; t < cube.triangles.size(); t += 3) std::swap(cube.triangles[t][0], cube.triangles[t][1]);
  const plc::Plc plc = plc::build_plc(cube);
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 12u);
  EXPECT_NEAR(inside_volume(plc), 1.0, 1e-12);
}

Point3 rounded_to_single(const Point3& p) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(p.x), rounded(p.y), rounded(p.z)};
}

TEST(PlcFacets, RotatedCubeInSinglePrecisionHasSixFacets) {
  for (const double distance : {0, 10, 1000}) {
    plc::InputPlc cube = rotated(rotation(0.3, 0.7, -0.2, 0.55), gridded_cube(8));
    for (Point3& p : cube.vertices) p = rounded_to_single(p + Point3{distance, -distance, 0});
    const plc::Plc plc = plc::build_plc(cube);
    expect_valid(plc);
    EXPECT_EQ(plc.facets.size(), 6u) << distance;
    EXPECT_GT(plc::build_plc(cube, {1.01 * usual_flatness}).facets.size(), 6u) << "the tolerance that was asked for";
  }
}

TEST(Flatness, OnlyTheUsualToleranceIsRaisedAndOnlyForRoundedCoordinates) {
  const std::vector<Point3> whole = {{0, 0, 0}, {1000000, 3, 0}, {5, 7, 12}}, twice = {{0, 0, 0}, {0.1, 0, 0}};
  const std::vector<Point3> single = {{0, 0, 0}, rounded_to_single({0.1, 0, 0})};
  EXPECT_EQ(flatness_for(whole, usual_flatness), usual_flatness);
  EXPECT_EQ(flatness_for(twice, usual_flatness), usual_flatness);
  EXPECT_EQ(flatness_for(std::vector<Point3>{{HUGE_VAL, 0, 0}}, usual_flatness), usual_flatness);
  EXPECT_DOUBLE_EQ(flatness_for(single, usual_flatness), 0x1p-23);
  for (const double asked : {0.0, 1e-9, 1e-7}) EXPECT_EQ(flatness_for(single, asked), asked);
}

TEST(PlcFacets, GriddedCubeHasSixFacets) {
  const plc::Plc plc = plc::build_plc(gridded_cube(60));
  expect_valid(plc);
  EXPECT_EQ(plc.vertices.size(), 6u * 60 * 60 + 2);
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 12u * 60);
  EXPECT_EQ(grazeable_count(plc), 0u);
  for (const plc::Facet& f : plc.facets) {
    EXPECT_TRUE(f.exactly_flat);
    EXPECT_EQ(f.triangle_count, 2u * 60 * 60);
  }
}

TEST(PlcFacets, GriddedCubeTurnedByAnArbitraryMatrixHasSixFacetsThatAreFlatWithinTheTolerance) {
  const plc::Plc plc = plc::build_plc(rotated(arbitrary, gridded_cube(60)));
  expect_valid(plc);
  EXPECT_EQ(plc.vertices.size(), 6u * 60 * 60 + 2);
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 12u * 60);
  EXPECT_EQ(grazeable_count(plc), 0u);
  for (const plc::Facet& f : plc.facets) EXPECT_FALSE(f.exactly_flat);
}

TEST(PlcFacets, NoToleranceLeavesTheFoldsOfATurnedCube) {
  plc::PlcOptions options;
  options.flatness = 0;
  const plc::Plc plc = plc::build_plc(rotated(arbitrary, gridded_cube(10)), options);
  expect_valid(plc);
  EXPECT_GT(plc.facets.size(), 300u);
  EXPECT_EQ(plc.regions.size(), 2u);
}

TEST(PlcFacets, RotationsChangeNeitherFacetsNorSegments) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const plc::InputPlc& solid : {gridded_cube(7), l_shape(), schoenhardt(), unit_cube()}) {
    const plc::Plc straight = plc::build_plc(solid);
    for (int i = 0; i < 25; ++i) {
      const Matrix m = rotation(normal(random), normal(random), normal(random), normal(random));
      // Vertices that the faces of the solid share are turned alike, so that they stay equal and keep their ids.
      const plc::Plc turned = plc::build_plc(rotated(m, solid));
      expect_valid(turned);
      EXPECT_EQ(turned.facets.size(), straight.facets.size());
      EXPECT_EQ(segment_ends(turned), segment_ends(straight));
      EXPECT_EQ(segment_ends(turned, true), segment_ends(straight, true));
      EXPECT_NEAR(inside_volume(turned), inside_volume(straight), 1e-9);
    }
  }
}

TEST(PlcFacets, LShapeHasOneGrazeableSegment) {
  const plc::Plc plc = plc::build_plc(l_shape());
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 8u);
  EXPECT_EQ(plc.segments.size(), 18u);
  EXPECT_EQ(segment_ends(plc, true), (std::set<std::array<std::uint32_t, 2>>{{0, 6}}));
}

TEST(PlcFacets, SchoenhardtHasThreeGrazeableSegments) {
  const plc::Plc plc = plc::build_plc(schoenhardt());
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 8u);
  EXPECT_EQ(plc.segments.size(), 12u);
  EXPECT_EQ(grazeable_count(plc), 3u);
}

TEST(PlcFacets, FineCylinderKeepsItsCreases) {
  std::vector<std::array<double, 2>> circle;
  const int n = 2000;
  for (int i = 0; i < n; ++i) circle.push_back({std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n)});
  const plc::Plc plc = plc::build_plc(prism(circle));
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), n + 2u);
  EXPECT_EQ(plc.segments.size(), 3u * n);
  EXPECT_EQ(grazeable_count(plc), 0u);
}

TEST(PlcFacets, MarkersDivideAFlatFace) {
  plc::InputPlc cube = unit_cube();
  cube.triangle_markers.assign(12, 5);
  cube.triangle_markers[0] = 6;
  const plc::Plc plc = plc::build_plc(cube);
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 7u);
  EXPECT_EQ(plc.segments.size(), 13u);
  EXPECT_EQ(plc.facets[0].marker, 6);
  EXPECT_EQ(grazeable_count(plc), 1u) << "a segment within a flat face has 180 degrees of the domain";
}

TEST(PlcFacets, ASegmentOfTheInputDividesAFlatFaceAndKeepsItsMarker) {
  plc::InputPlc cube = unit_cube();
  cube.segments = {{cube.triangles[0][2], cube.triangles[0][0]}};  // the diagonal
  cube.segment_markers = {9};
  const plc::Plc plc = plc::build_plc(cube);
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 7u);
  ASSERT_EQ(plc.segments.size(), 13u);
  int marked = 0;
  for (const plc::Segment& s : plc.segments) marked += s.marker == 9;
  EXPECT_EQ(marked, 1);
}

TEST(PlcFacets, VerticesThatFallTogetherAreMergedInOrderOfAppearance) {
  plc::InputPlc soup;  // as STL has it: three vertices per triangle
  const plc::InputPlc cube = unit_cube();
  for (const auto& t : cube.triangles) {
    const auto v = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t c : t) soup.vertices.push_back(cube.vertices[c]);
    soup.triangles.push_back({v, v + 1, v + 2});
  }
  soup.vertices[3].x += 1e-12;
  const plc::Plc plc = plc::build_plc(soup);
  EXPECT_EQ(plc.vertices.size(), 8u);
  EXPECT_EQ(plc.vertex_of_input[0], 0u);
  EXPECT_EQ(plc.vertex_of_input[3], plc.vertex_of_input[0]);
  EXPECT_EQ(plc.world[0], cube.vertices[cube.triangles[0][0]]);
  EXPECT_NEAR(plc.largest_rounding, 1e-12, 1e-13);
}

TEST(PlcFacets, AVertexExactlyOnAnEdgeSplitsTheTrianglesThere) {
  plc::InputPlc cube = unit_cube();
  cube.vertices.push_back({0.5, 0, 0});     // on an edge of the cube
  cube.vertices.push_back({0.25, 0.5, 1});  // within a facet
  const plc::Plc plc = plc::build_plc(cube);
  expect_valid(plc);
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 13u);
  EXPECT_EQ(segment_ends(plc).count({0, 8}), 1u);
  EXPECT_EQ(segment_ends(plc).count({1, 8}), 1u);
  std::set<std::uint32_t> on_facets;
  for (const auto& t : plc.triangles) on_facets.insert(t.begin(), t.end());
  EXPECT_EQ(on_facets.size(), 10u);
}

TEST(PlcFacets, TrianglesWithoutAreaBoundNothingAndMayCloseTheGapAtAVertexOnAnEdge) {
  plc::InputPlc input = unit_cube();
  input.triangles.push_back({0, 1, 1});
  EXPECT_EQ(plc::build_plc(input).facets.size(), 6u);

  input = unit_cube();
  input.vertices.push_back({0.5, 0, 0});
  const auto along = std::ranges::find_if(
      input.triangles, [](const Triangle& t) { return std::ranges::count(t, 0u) + std::ranges::count(t, 1u) == 2; });
  const Triangle whole = *along;
  for (std::uint32_t& v : *along) v = v == 0 ? 8 : v;
  input.triangles.push_back(whole);
  for (std::uint32_t& v : input.triangles.back()) v = v == 1 ? 8 : v;
  input.triangles.push_back({0, 8, 1});
  const plc::Plc built = plc::build_plc(input);
  EXPECT_EQ(built.facets.size(), 6u);
  EXPECT_EQ(built.segments.size(), 13u);
}

TEST(PlcFacets, AFacetMayHaveManyVerticesThatItsTrianglesDoNotName) {
  plc::InputPlc cube = unit_cube();
  const int n = 40;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) cube.vertices.push_back({double(i) / n, double(j) / n, 1});
  const plc::Plc plc = plc::build_plc(cube);
  expect_valid(plc);
  EXPECT_EQ(plc.vertices.size(), 4u + (n + 1) * (n + 1));
  EXPECT_EQ(plc.facets.size(), 6u);
  EXPECT_EQ(plc.segments.size(), 8u + 4 * n);
  EXPECT_EQ(plc.facets[1].triangle_count, 2u * n * n);
  EXPECT_NEAR(inside_volume(plc), 1, 1e-12);
}

TEST(PlcFacets, ExactlyFlatMeansThatAllVerticesAreInOnePlane) {
  const plc::Plc plc = plc::build_plc(rotated(arbitrary, l_shape()));
  for (const plc::Facet& f : plc.facets) {
    bool flat = true;
    const auto& t = plc.triangles_of(f)[0];
    for (const auto& s : plc.triangles_of(f))
      for (const VertexId v : s)
        flat = flat && orient3d(plc.vertices[t[0]], plc.vertices[t[1]], plc.vertices[t[2]], plc.vertices[v]) == 0;
    EXPECT_EQ(f.exactly_flat, flat);
  }
}

}  // namespace
}  // namespace ccdt
