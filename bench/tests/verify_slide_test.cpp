#include <gtest/gtest.h>

#include <cmath>

#include "bench/tests/verify_cases.h"
#include "bench/verify/verify.h"

namespace ccdt {
namespace {

verify::VerifyOptions sliding() {
  verify::VerifyOptions options;
  options.boundary = verify::VerifyOptions::Boundary::slide;
  return options;
}

constexpr const char* must_stay = "input vertices that may not slide";

/// Moves a vertex of the mesh; the input stays as it is.
MeshedInput moved(MeshedInput m, const Point3& from, const Point3& to, const Transform& transform = unmoved) {
  m.mesh.vertices.at(vertex_at(m.mesh, transform(from))) = transform(to);
  return m;
}

/// Wrong where vertices must stay, right where they may slide.
void expect_slide(const MeshedInput& m) {
  expect_failure(m, "input vertices");
  expect_ok(m, sliding());
}

/// Wrong even where vertices may slide.
void expect_no_slide(const MeshedInput& m, const std::string& check) {
  expect_failure(m, "input vertices");
  expect_failure(m, check, sliding());
}

TEST(VerifySlide, AMeshThatKeptItsBoundaryIsRight) {
  for (const MeshedInput& m : {cube(), two_regions(), plate(), cube_in_five(), bipyramid(true),
                               make_grid_mesh({3, 3, 3}, around_a_hole, true, rotated)})
    expect_ok(m, sliding());
}

TEST(VerifySlide, VerticesMaySlideInAFlatFacet) {
  expect_slide(moved(cube(), {1, 1, 0}, {1.1, 0.95, 0}));
  const MeshedInput turned = make_grid_mesh({3, 3, 3}, everywhere, false, rotated);
  expect_slide(moved(turned, {1, 1, 0}, {1.1, 0.95, 0}, rotated));
  expect_slide(moved(turned, {3, 2, 1}, {3, 1.87, 1.13}, rotated));
}

TEST(VerifySlide, VerticesMaySlideAlongAStraightEdge) {
  expect_slide(moved(cube(), {1, 0, 0}, {1.2, 0, 0}));
  expect_slide(moved(make_grid_mesh({3, 3, 3}, everywhere, false, rotated), {3, 1, 0}, {3, 0.9, 0}, rotated));
  // Both vertices inside the edge.
  expect_slide(moved(moved(cube(), {1, 0, 0}, {1.2, 0, 0}), {2, 0, 0}, {2.1, 0, 0}));
}

TEST(VerifySlide, ACornerMayNotSlide) {
  const MeshedInput along_edge = moved(cube(), {0, 0, 0}, {0.1, 0, 0});
  expect_no_slide(along_edge, must_stay);
  const MeshedInput turned = make_grid_mesh({3, 3, 3}, everywhere, false, rotated);
  expect_no_slide(moved(turned, {3, 3, 3}, {3, 2.9, 3}, rotated), must_stay);
  // Corners of the hole inside.
  const MeshedInput hollow = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved);
  expect_no_slide(moved(hollow, {1, 1, 1}, {1, 1, 1.1}), must_stay);
}

TEST(VerifySlide, AVertexMayNotLeaveItsFacetOrItsEdge) {
  for (const double off : {1e-6, -1e-6, 0.1}) {
    expect_no_slide(moved(cube(), {1, 1, 0}, {1, 1, off}), "input facets");
    expect_no_slide(moved(cube(), {1, 0, 0}, {1, off, 0}), "input segments");
  }
}

TEST(VerifySlide, OnACurvedSurfaceNoVertexMaySlide) {
  const auto bulge = [](const Point3& p) {
    return Point3{p.x, p.y, p.z + 0.02 * p.z * (p.x * (3 - p.x) + p.y * (3 - p.y))};
  };
  const MeshedInput m = make_grid_mesh({3, 3, 3}, everywhere, false, bulge);
  // At the bottom it is flat, at the sides too; the edges of the top are bent.
  expect_slide(moved(m, {1, 1, 0}, {1.1, 1, 0}, bulge));
  expect_slide(moved(m, {1, 0, 1}, {1.1, 0, 1.05}, bulge));
  expect_slide(moved(m, {0, 0, 1}, {0, 0, 1.1}, bulge));
  expect_no_slide(moved(m, {1, 1, 3}, {1.1, 1, 3}, bulge), must_stay);
  expect_no_slide(moved(m, {1, 0, 3}, {1.1, 0, 3}, bulge), must_stay);
}

/// Bent so little that each edge alone would pass as flat.
TEST(VerifySlide, OnASlightlyCurvedSurfaceNoVertexMaySlide) {
  const auto bulge = [](const Point3& p) {
    return Point3{p.x, p.y, p.z + 5e-8 * p.z * (p.x * (12 - p.x) + p.y * (12 - p.y))};
  };
  const MeshedInput m = make_grid_mesh({12, 12, 1}, everywhere, false, bulge);
  expect_ok(m, sliding());
  expect_slide(moved(m, {5, 5, 0}, {5.2, 5.1, 0}, bulge));
  expect_no_slide(moved(m, {5, 5, 1}, {5.2, 5.1, 1}, bulge), must_stay);
}

/// The top is flat in the middle and twisted at two sides, so little that no edge separates the parts.
TEST(VerifySlide, VerticesMaySlideInTheFlatPartOfASlightlyCurvedSurface) {
  const auto bend = [](const Point3& p) {
    const double beyond = std::fmax(0, std::fabs(p.x - 6) - 3);
    return Point3{p.x, p.y, p.z - 1e-8 * p.z * beyond * (p.y - 6) * (p.y - 6)};
  };
  const MeshedInput m = make_grid_mesh({12, 12, 1}, everywhere, false, bend);
  expect_ok(m, sliding());
  expect_slide(moved(m, {6, 6, 1}, {6.2, 6.1, 1}, bend));
  expect_no_slide(moved(m, {1, 2, 1}, {1.2, 2, 1}, bend), must_stay);
  expect_no_slide(moved(m, {6, 6, 1}, {6.2, 6.1, 1 - 1e-6}, bend), "input facets");
}

TEST(VerifySlide, VerticesMaySlideInAnInteriorFacetAndAlongItsBorder) {
  const MeshedInput m = two_regions();
  expect_slide(moved(m, {2, 1, 1}, {2, 1.1, 1.05}));
  expect_slide(moved(m, {2, 1, 0}, {2, 1.1, 0}));
  expect_no_slide(moved(m, {2, 1, 1}, {2.01, 1, 1}), "input facets");
  expect_no_slide(moved(m, {2, 1, 0}, {2.1, 1, 0}), "input segments");
  expect_no_slide(moved(m, {2, 0, 0}, {2.1, 0, 0}), must_stay);
}

TEST(VerifySlide, AChangeOfMarkersIsAnEdge) {
  MeshedInput m = make_grid_mesh({4, 4, 2}, everywhere, false, unmoved);
  expect_slide(moved(m, {2, 2, 0}, {2.1, 2, 0}));
  for (const auto& t : m.input.triangles) {
    bool is_left = true;
    for (const std::uint32_t v : t) is_left = is_left && m.input.vertices[v].x <= 2;
    m.input.triangle_markers.push_back(is_left ? 1 : 2);
  }
  expect_slide(moved(m, {2, 2, 0}, {2, 2.1, 0}));
  expect_slide(moved(m, {1, 2, 0}, {1.1, 2.1, 0}));
  expect_no_slide(moved(m, {2, 2, 0}, {2.1, 2, 0}), "input segments");
  expect_no_slide(moved(m, {2, 0, 0}, {2.1, 0, 0}), must_stay);
}

/// A line of three vertices within the cube.
MeshedInput cube_with_line(const Point3& bend = {0, 0, 0}) {
  MeshedInput m = make_grid_mesh({4, 4, 4}, everywhere, false, unmoved);
  const auto at = [&](double x) { return vertex_at(m.mesh, {x, 2, 2}); };
  m.input.inside = plc::InputPlc::Inside::seeds;
  m.input.segments = {{at(1), at(2)}, {at(2), at(3)}};
  const std::uint32_t middle = at(2);
  m.input.vertices[middle] = m.mesh.vertices[middle] = Point3{2, 2, 2} + bend;
  return m;
}

TEST(VerifySlide, TheMiddleOfAStraightLineMaySlideAlongIt) {
  const MeshedInput m = cube_with_line();
  expect_ok(m, sliding());
  expect_slide(moved(m, {2, 2, 2}, {2.1, 2, 2}));
  expect_no_slide(moved(m, {2, 2, 2}, {2, 2.1, 2}), "input segments");
  expect_no_slide(moved(m, {3, 2, 2}, {3.1, 2, 2}), must_stay);
}

TEST(VerifySlide, AKinkMayNotSlide) {
  const MeshedInput m = cube_with_line({0, 0.01, 0});
  expect_ok(m, sliding());
  expect_no_slide(moved(m, {2, 2.01, 2}, {2.1, 2.01, 2}), must_stay);
}

TEST(VerifySlide, WhereThreeSegmentsMeetNothingSlides) {
  MeshedInput m = cube_with_line();
  m.input.segments.push_back({vertex_at(m.mesh, {2, 2, 2}), vertex_at(m.mesh, {2, 3, 2})});
  expect_ok(m, sliding());
  expect_no_slide(moved(m, {2, 2, 2}, {2.1, 2, 2}), must_stay);
}

TEST(VerifySlide, AnIsolatedVertexMayNotMove) {
  const MeshedInput m = make_grid_mesh({3, 3, 3}, everywhere, false, unmoved);
  expect_no_slide(moved(m, {1, 1, 1}, {1.1, 1, 1}), must_stay);
}

/// Segments that the input gives along its edges, and in its facets.
TEST(VerifySlide, SegmentsOnFacetsHoldTheirVerticesInTheirLine) {
  MeshedInput m = make_grid_mesh({4, 4, 2}, everywhere, false, unmoved);
  const auto add = [&](const Point3& a, const Point3& b) {
    m.input.segments.push_back({vertex_at(m.mesh, a), vertex_at(m.mesh, b)});
  };
  for (const double x : {0.0, 1.0, 2.0, 3.0}) add({x, 0, 0}, {x + 1, 0, 0});
  for (const double x : {1.0, 2.0}) add({x, 2, 0}, {x + 1, 2, 0});
  expect_ok(m, sliding());
  expect_slide(moved(m, {2, 0, 0}, {2.1, 0, 0}));
  expect_slide(moved(m, {2, 2, 0}, {2.1, 2, 0}));
  expect_slide(moved(m, {2, 1, 0}, {2.1, 1.1, 0}));
  expect_no_slide(moved(m, {2, 2, 0}, {2, 2.1, 0}), "input segments");
  expect_no_slide(moved(m, {1, 2, 0}, {1.1, 2, 0}), must_stay);
}

TEST(VerifySlide, VerticesMayBeGone) {
  MeshedInput m = make_grid_mesh({2, 2, 2}, everywhere, false, [](const Point3& p) { return 0.5 * p; });
  const std::uint32_t middle = vertex_at(m.mesh, {0.5, 0.5, 0.5});
  m.mesh = cube_in_five().mesh;
  expect_failure(m, "input vertices");
  // The middle of the cube is on no facet.
  expect_failure(m, must_stay, sliding());
  m.input.vertices[middle] = {0.5, 0.5, 0};
  expect_slide(m);
}

TEST(VerifySlide, VerticesMaySlideOnPolygonsWithHoles) {
  MeshedInput m = plate();
  // Vertices of the input that no polygon has.
  expect_slide(moved(m, {2, 0, 0}, {2.1, 0, 0}));
  expect_slide(moved(m, {3, 1, 1}, {3, 1.1, 1}));
  expect_no_slide(moved(m, {2, 0, 0}, {2, 0.1, 0}), "input segments");
  expect_no_slide(moved(m, {1, 1, 0}, {1, 1.1, 0}), must_stay);
}

}  // namespace
}  // namespace ccdt
