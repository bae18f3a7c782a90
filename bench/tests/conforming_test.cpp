#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "bench/experiments/conforming/conforming_delaunay.h"
#include "bench/experiments/conforming/smallest_spheres.h"
#include "bench/experiments/existence_experiments.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/plc/build_plc.h"
#include "models/flatten.h"
#include "models/solids.h"

namespace ccdt {
namespace {

using conforming::ConformingDelaunay;
using conforming::SphereContent;
using protection::Protection;
using Corners = std::array<Point3, 3>;

// ---- The smallest sphere of a triangle ------------------------------------------------------------------------------

TEST(SmallestSphere, HasItsCenterInThePlaneOfTheTriangle) {
  const Corners right = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};  // center (2, 2, 0), squared radius 8
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {2, 2, 0}), 1);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {2, 2, 2}), 1);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {4, 4, 0}), 0);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {2, 4, 2}), 0);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {2, 2, 3}), -1);
  // The circumcenter of an obtuse triangle is outside it: here (2, -1.5, 0), with radius 2.5.
  const Corners obtuse = {{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}}};
  EXPECT_EQ(conforming::side_of_smallest_sphere(obtuse, {2, -4, 0}), 0);
  EXPECT_EQ(conforming::side_of_smallest_sphere(obtuse, {2, -3, 1}), 1);
  EXPECT_EQ(conforming::side_of_smallest_sphere(obtuse, {2, -4, 1}), -1);
}

TEST(SmallestSphere, IsExactAtTheLimitsOfTheGrid) {
  const double big = 0x1p51;
  const Corners right = {{{-big, -big, 0}, {big, -big, 0}, {-big, big, 0}}};
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {big, big, 0}), 0);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {big, big, 1}), -1);
  EXPECT_EQ(conforming::side_of_smallest_sphere(right, {big - 1, big, 0}), 1);
}

TEST(SmallestSphere, DoesNotDependOnTheOrderOfTheCorners) {
  const Corners t = {{{5, 1, -3}, {-2, 7, 4}, {0, -6, 9}}};
  for (double x = -8; x <= 8; ++x)
    for (double z = -8; z <= 14; ++z) {
      const Point3 p{x, 1, z};
      const int side = conforming::side_of_smallest_sphere(t, p);
      EXPECT_EQ(conforming::side_of_smallest_sphere({t[1], t[2], t[0]}, p), side);
      EXPECT_EQ(conforming::side_of_smallest_sphere({t[1], t[0], t[2]}, p), side);
    }
}

TEST(SmallestSpheres, HoldWhatASearchOfAllVerticesFinds) {
  const plc::Plc plc = plc::build_plc(models::make_solid("rough-sphere", 0.3));
  std::array<std::size_t, 3> found{};
  const auto contents = conforming::contents_of_smallest_spheres(plc.triangles, plc.vertices);
  for (std::size_t i = 0; i < plc.triangles.size(); ++i) {
    const auto& [a, b, c] = plc.triangles[i];
    SphereContent expected = SphereContent::nothing;
    for (std::uint32_t v = 0; v < plc.vertices.size(); ++v) {
      if (v == a || v == b || v == c) continue;
      const int side =
          conforming::side_of_smallest_sphere({plc.vertices[a], plc.vertices[b], plc.vertices[c]}, plc.vertices[v]);
      if (side > 0) expected = SphereContent::vertices;
      if (side == 0 && expected == SphereContent::nothing) expected = SphereContent::touching;
    }
    EXPECT_EQ(contents[i], expected) << i;
    ++found[static_cast<std::size_t>(expected)];
  }
  EXPECT_GT(found[0], 0u);
  EXPECT_GT(found[2], 0u);
}

// ---- Conditions -----------------------------------------------------------------------------------------------------

experiments::ConditionsRow conditions_of(const InputPlc& input) {
  experiments::ConditionsRow row;
  experiments::count_violations(plc::build_plc(input), {}, row);
  return row;
}

/// A flat tetrahedron: the apex is so low above the base that it is in the base's smallest sphere, as the only vertex.
InputPlc tetrahedron(double height) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {2, 2, height}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return plc;
}

TEST(Conditions, OfATetrahedronAreTheorem1sAlways) {
  for (const double height : {1.0, 4.0, 16.0}) EXPECT_TRUE(conditions_of(tetrahedron(height)).fulfills_theorem());
}

TEST(Conditions, OfAFlatTetrahedronAreNotRadovitzkysAndOrtiz) {
  const experiments::ConditionsRow flat = conditions_of(tetrahedron(1));
  EXPECT_EQ(flat.faces, 4u);
  EXPECT_GT(flat.occupied, 0u);
  EXPECT_FALSE(flat.fulfills_theirs());
}

TEST(Conditions, OfARegularTetrahedronAreBoth) {
  InputPlc regular;
  regular.vertices = {{0, 0, 0}, {8, 8, 0}, {8, 0, 8}, {0, 8, 8}};
  regular.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const experiments::ConditionsRow row = conditions_of(regular);
  EXPECT_TRUE(row.fulfills_theirs());
  EXPECT_EQ(row.touched, 0u);
  EXPECT_TRUE(row.fulfills_theorem());
}

TEST(Conditions, AllowVerticesOnTheSpheresOfARegularGrid) {
  const experiments::ConditionsRow cube = conditions_of(models::make_solid("cube", 0.25));
  EXPECT_EQ(cube.faces, 192u);
  EXPECT_EQ(cube.touched, 192u);  // each right triangle has the fourth corner of its square on its circle
  EXPECT_TRUE(cube.fulfills_theirs());
  EXPECT_TRUE(cube.fulfills_theorem());
}

TEST(Conditions, OfRadovitzkyAndOrtizImplyTheorem1s) {
  for (const models::Solid& solid : models::solids())
    for (const double factor : {1.0, 0.5, 0.3}) {
      InputPlc input = models::make_solid(solid.name, solid.coarsest);
      models::flatten(input, factor);
      const experiments::ConditionsRow row = conditions_of(input);
      EXPECT_EQ(row.contradictions, 0u) << solid.name << " " << factor;
      if (row.occupied + row.touched == 0) {
        EXPECT_TRUE(row.fulfills_theorem()) << solid.name << " " << factor;
      }
    }
}

TEST(Conditions, SeeTheReflexEdgesOfSchoenhardtsPolyhedron) {
  const experiments::ConditionsRow row = conditions_of(models::make_solid("schoenhardt", 0));
  EXPECT_GT(row.missing_edges, 0u);  // of three: its vertices are nearly on one sphere
  EXPECT_FALSE(row.fulfills_theirs());
  EXPECT_FALSE(row.fulfills_theorem());
}

// ---- Conforming Delaunay tetrahedralizations ------------------------------------------------------------------------

constexpr std::size_t enough = 100000;

ConformingDelaunay conform(const InputPlc& input, Protection protection, std::size_t most = enough) {
  return conforming::make_conforming(plc::build_plc(input), protection, most);
}

/// Is every piece of a segment an edge and every face of a facet a face, and do the faces have the facets' area?
void expect_conforming(const ConformingDelaunay& found, const plc::Plc& plc) {
  ASSERT_TRUE(found.is_conforming);
  const delaunay::Delaunay& d = found.surface.delaunay;
  for (const auto& [a, b] : found.surface.chains.pieces()) EXPECT_TRUE(delaunay::has_edge(d, a, b));
  double area = 0, expected_area = 0;
  for (const auto& [a, b, c] : found.faces.triangles) {
    EXPECT_NE(delaunay::find_face(d, a, b, c), delaunay::no_neighbor);
    area += length(area_vector({d.point(a), d.point(b), d.point(c)}));
  }
  for (const auto& [a, b, c] : plc.triangles)
    expected_area += length(area_vector({plc.vertices[a], plc.vertices[b], plc.vertices[c]}));
  EXPECT_NEAR(area / expected_area, 1, 1e-9);
  EXPECT_EQ(d.vertices.size(), plc.vertices.size() + found.steiner_vertices());
}

TEST(Conforming, NeedsNoVertexWhereAllFacesAreDelaunay) {
  for (const char* name : {"cube", "sphere"}) {
    const InputPlc input = models::make_solid(name, 0.25);
    const ConformingDelaunay found = conform(input, Protection::midpoint);
    expect_conforming(found, plc::build_plc(input));
    EXPECT_EQ(found.missing_segments + found.missing_faces, 0u);
    EXPECT_EQ(found.steiner_vertices(), 0u);
  }
}

/// A long tetrahedron with a small one hanging beside the middle of its longest edge, so near that its vertices are in
/// every sphere through the ends of that edge: the edge and its two faces are missing. It is convex there, so that CCDT
/// needs no vertex. By hand: one vertex at the middle of the edge is enough.
InputPlc edge_with_a_neighbor() {
  InputPlc plc;
  plc.vertices = {{-8, 0, 0}, {8, 0, 0}, {0, -8, 8}, {0, 8, 8}, {-1, 0, -1}, {1, 0, -1}, {0, -1, -3}, {0, 1, -3}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {4, 5, 6}, {4, 7, 5}, {4, 6, 7}, {5, 7, 6}};
  return plc;
}

TEST(Conforming, SplitsAMissingEdgeThatIsNotGrazeable) {
  const InputPlc input = edge_with_a_neighbor();
  const plc::Plc plc = plc::build_plc(input);
  for (const Protection protection : {Protection::midpoint, Protection::shell}) {
    const ConformingDelaunay found = conform(input, protection);
    expect_conforming(found, plc);
    EXPECT_EQ(found.missing_segments, 1u);
    EXPECT_EQ(found.missing_faces, 2u);
    EXPECT_EQ(found.on_segments, 1u);
    EXPECT_EQ(found.in_facets, 0u);
  }
  experiments::ConditionsRow row;
  experiments::count_violations(plc, {}, row);
  EXPECT_EQ(row.missing_edges, 0u);
}

/// A tetrahedron whose base is pierced from below by the line of two vertices near its center, outside; its edges are
/// far away. By hand: one vertex at the center of the base is enough.
InputPlc face_with_a_neighbor() {
  InputPlc plc;
  plc.vertices = {{-6, -6, 0}, {12, -6, 0}, {-6, 12, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, -3}, {-1, 1, -3}, {-1, -1, -3}};
  plc.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 6, 5}, {4, 7, 6}, {4, 5, 7}, {5, 6, 7}};
  return plc;
}

TEST(Conforming, AddsAVertexInAMissingFace) {
  const InputPlc input = face_with_a_neighbor();
  const ConformingDelaunay found = conform(input, Protection::midpoint);
  expect_conforming(found, plc::build_plc(input));
  EXPECT_EQ(found.missing_segments, 0u);
  EXPECT_EQ(found.missing_faces, 1u);
  EXPECT_GE(found.steiner_vertices(), 1u);
}

TEST(Conforming, HasAllFacesOfFlattenedSolids) {
  for (const char* name : {"rough-sphere", "bracket"}) {
    InputPlc input = models::make_solid(name, 0);
    models::flatten(input, 0.3);
    const ConformingDelaunay found = conform(input, Protection::midpoint);
    expect_conforming(found, plc::build_plc(input));
    EXPECT_GT(found.missing_faces, 0u) << name;
    EXPECT_GT(found.in_facets + found.on_segments, 0u) << name;
  }
}

TEST(Conforming, GivesUpWithTooManyVertices) {
  InputPlc input = models::make_solid("rough-sphere", 0.3);
  const plc::Plc plc = plc::build_plc(input);
  const ConformingDelaunay found = conform(input, Protection::midpoint, plc.vertices.size());
  EXPECT_GT(found.missing_faces, 0u);
  EXPECT_FALSE(found.is_conforming);
}

}  // namespace
}  // namespace ccdt
