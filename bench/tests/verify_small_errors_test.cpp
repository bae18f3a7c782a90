#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/tests/verify_cases.h"
#include "bench/verify/verify.h"

// One small error each, in an otherwise right mesh: the least that a check must find.

namespace ccdt {
namespace {

/// How many failures a check has.
std::uint64_t failures(const MeshedInput& m, const std::string& name, const verify::VerifyOptions& options = {}) {
  return check_named(verify::verify(m.input, m.mesh, options), name).failed;
}

/// A cube of unit cubes.
MeshedInput cube_of(int side) {
  return make_grid_mesh({side, side, side}, everywhere, false, unmoved);
}

void add_tetrahedron(const std::array<std::uint32_t, 4>& tetrahedron, MeshedInput& m) {
  m.mesh.tetrahedra.push_back(tetrahedron);
  m.mesh.regions.push_back(0);
}

TEST(Verify, ATetrahedronWithoutVolumeIsFound) {
  MeshedInput m = cube_in_five();
  EXPECT_EQ(failures(m, "positive orientation"), 0u);
  add_tetrahedron({0, 1, 3, 2}, m);  // a face of the cube
  EXPECT_EQ(failures(m, "positive orientation"), 1u);
}

TEST(Verify, AVertexTwiceInATetrahedronIsFound) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      MeshedInput m = cube_in_five();
      m.mesh.tetrahedra[2][i] = m.mesh.tetrahedra[2][j];
      EXPECT_EQ(failures(m, "valid elements"), 1u) << i << " " << j;
    }
}

TEST(Verify, TheNumberAfterTheLastVertexIsNoVertex) {
  const std::uint32_t last = 7;
  for (const std::uint32_t v : {last, last + 1}) {
    const std::uint64_t wrong = v == last ? 0 : 1;
    MeshedInput m = cube_in_five();
    std::ranges::replace(m.mesh.tetrahedra[3], last, v);
    EXPECT_EQ(failures(m, "valid elements"), wrong);
    m = cube_in_five();
    m.mesh.faces = {{0, 1, v}};
    EXPECT_EQ(failures(m, "valid elements"), wrong) << "a face";
    m = cube_in_five();
    m.mesh.edges = {{1, v}};
    EXPECT_EQ(failures(m, "valid elements"), wrong) << "an edge";
  }
}

TEST(Verify, EachCoordinateMustBeFinite) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto axis : {&Point3::x, &Point3::y, &Point3::z})
    for (const double wrong : {infinity, -infinity, nan}) {
      MeshedInput m = cube_in_five();
      m.mesh.vertices[5].*axis = wrong;
      EXPECT_EQ(failures(m, "finite coordinates"), 1u);
    }
}

TEST(Verify, AttributesAreAsManyAsElementsOrNone) {
  for (const bool too_many : {false, true}) {
    const std::size_t count = too_many ? 3 : 1;
    MeshedInput m = cube_in_five();
    m.mesh.faces = {{0, 1, 2}, {0, 1, 4}};
    m.mesh.edges = {{0, 1}, {0, 2}};
    EXPECT_EQ(failures(m, "valid elements"), 0u);
    m.mesh.face_markers.assign(count, 1);
    EXPECT_EQ(failures(m, "valid elements"), 1u);
    m.mesh.edge_markers.assign(count, 1);
    EXPECT_EQ(failures(m, "valid elements"), 2u);
    m.mesh.regions.resize(too_many ? 6 : 4, 0);
    EXPECT_EQ(failures(m, "valid elements"), 3u);
  }
}

TEST(Verify, AllFailuresCountAndTheFirstAreDescribed) {
  MeshedInput m = cube();
  for (auto& tetrahedron : m.mesh.tetrahedra) std::swap(tetrahedron[0], tetrahedron[1]);
  const verify::Verification v = verify::verify(m.input, m.mesh);
  EXPECT_EQ(check_named(v, "positive orientation").failed, m.mesh.tetrahedra.size());
  EXPECT_EQ(check_named(v, "positive orientation").examples.size(), 5u);
}

TEST(Verify, AVertexThatIsNotUsedIsNamedButNotWrong) {
  MeshedInput m = cube();
  m.mesh.vertices.push_back({0.5, 0.5, 7});
  expect_ok(m);
  EXPECT_EQ(failures(m, "vertices in use"), 1u);
}

TEST(Verify, TwoTetrahedraOnOneSideOfAFaceAreFound) {
  MeshedInput m = bipyramid(true);
  m.mesh.vertices.push_back({0, 0, 1});
  add_tetrahedron({0, 1, 2, 5}, m);  // in that above the triangle
  EXPECT_GT(failures(m, "faces of one or two tetrahedra"), 0u);
  m = bipyramid(true);
  m.mesh.vertices.push_back({0, 0, 1});
  m.mesh.tetrahedra[1] = {0, 1, 2, 5};
  EXPECT_EQ(failures(m, "faces of one or two tetrahedra"), 1u) << "two in all, on one side";
}

TEST(Verify, AVolumeThatIsSlightlyTooSmallIsFound) {
  MeshedInput m = cube_of(12);
  m.mesh.tetrahedra.erase(m.mesh.tetrahedra.begin() + 5000);  // one part of 10,368
  m.mesh.regions.pop_back();
  expect_failure(m, "volume");
  // The tolerance of flatness allows 6.5e-6 here: 4e-8 of the side times the area.
  m = cube();
  m.mesh.vertices[vertex_at(m.mesh, {1, 1, 0})].z += 1.5e-5;
  const verify::Verification v = verify::verify(m.input, m.mesh);
  EXPECT_NEAR(v.input_volume - v.mesh_volume, 1.5e-5, 1e-9);
  expect_failure(m, "volume");
}

TEST(Verify, AVolumeThatIsSlightlyTooLargeIsFound) {
  MeshedInput m = cube();
  m.mesh.vertices[vertex_at(m.mesh, {1, 1, 0})].z -= 1.5e-5;
  expect_failure(m, "volume");
}

TEST(Verify, AVertexHasItsPlaceWithinATenthOfTheTolerance) {
  MeshedInput m = cube();
  const std::uint32_t v = vertex_at(m.mesh, {1, 1, 0});
  m.mesh.vertices[v].x += 2e-9;  // the side times a tenth of the tolerance of flatness is 3e-9
  expect_ok(m);
  m.mesh.vertices[v].x = 1 + 1e-8;
  expect_failure(m, "input vertices");
}

TEST(Verify, ATetrahedronFarFromTheInputIsFound) {
  MeshedInput m = cube();
  const auto first = static_cast<std::uint32_t>(m.mesh.vertices.size());
  m.mesh.vertices.insert(m.mesh.vertices.end(), {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}, {9, 9, 10}});
  add_tetrahedron({first, first + 1, first + 2, first + 3}, m);
  EXPECT_EQ(failures(m, "tetrahedra in the domain"), 1u);
  EXPECT_EQ(failures(m, "boundary faces on input facets"), 4u);
}

/// A bipyramid whose triangle is a facet. The three tetrahedra around its axis pierce that.
MeshedInput pierced_bipyramid() {
  MeshedInput m = bipyramid(false);
  m.mesh.constrained_delaunay = false;
  m.input.triangles.push_back({0, 1, 2});
  return m;
}

TEST(Verify, TetrahedraThatPierceAFacetAreInTwoRegions) {
  const MeshedInput m = pierced_bipyramid();
  EXPECT_GT(failures(m, "input facets"), 0u);
  EXPECT_EQ(failures(m, "tetrahedra in the domain"), 3u);
}

TEST(Verify, OneTetrahedronInAHoleIsFound) {
  MeshedInput m = bipyramid(true);
  m.input.triangles.push_back({0, 1, 2});
  m.input.inside = plc::InputPlc::Inside::seeds;
  expect_ok(m);
  for (const std::vector<Point3>& holes :
       {std::vector<Point3>{{0, 0, -1}}, std::vector<Point3>{{0, 0, -1}, {0.1, 0, -0.5}}}) {
    m.input.holes = holes;
    EXPECT_EQ(failures(m, "holes"), 1u) << holes.size() << " seeds";
    EXPECT_EQ(failures(m, "tetrahedra in the domain"), 1u) << holes.size() << " seeds";
  }
}

TEST(Verify, ARegionWithTwoSeedsMayHaveEitherAttribute) {
  MeshedInput m = two_regions();
  m.input.regions.push_back({{1.4, 2.3, 2.6}, 5, 0});
  expect_ok(m);
  for (std::size_t t = 0; t < m.mesh.regions.size(); ++t)
    if (m.mesh.regions[t] == 1 && t % 2 == 0) m.mesh.regions[t] = 5;
  expect_ok(m);
  *std::ranges::find(m.mesh.regions, 2) = 5;
  EXPECT_EQ(failures(m, "regions"), 1u);
}

/// A cube with a cube inside, and a wall that joins them: within one shell, but two facets away from the outside.
MeshedInput cube_with_joined_core(const CubeRegion& region) {
  MeshedInput m = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved);
  const auto at = [&](double x, double y, double z) { return vertex_at(m.mesh, {x, y, z}); };
  m.input.triangles.push_back({at(0, 1, 1), at(1, 1, 1), at(1, 2, 1)});
  m.input.triangles.push_back({at(0, 1, 1), at(1, 2, 1), at(0, 2, 1)});
  m.mesh = make_grid_mesh({3, 3, 3}, region, false, unmoved).mesh;
  return m;
}

TEST(Verify, ARegionThatMayBeInsideOrOutsideMayBeFilledOrNot) {
  expect_ok(cube_with_joined_core(around_a_hole));
  expect_ok(cube_with_joined_core(everywhere));
}

TEST(Verify, ASegmentThatLeadsAwayFromTheDomainMayBeMissing) {
  for (const bool away : {false, true}) {
    MeshedInput m = cube();
    m.input.segments = {{vertex_at(m.mesh, {1, 1, 3}), static_cast<std::uint32_t>(m.input.vertices.size())}};
    m.input.vertices.push_back({1.25, 2.5, away ? 5.0 : 1.0});
    EXPECT_EQ(failures(m, "input segments"), away ? 0u : 1u);
    EXPECT_EQ(verify::verify(m.input, m.mesh, tetrahedra_alone).ok(), away);
  }
}

TEST(Verify, ASegmentDoesNotRunOverAVertexBesideIt) {
  for (const double beside : {0.0, 2e-5}) {
    MeshedInput m = cube();
    const std::uint32_t middle = vertex_at(m.mesh, {1, 1, 1});
    m.input.segments = {{vertex_at(m.mesh, {0, 0, 0}), vertex_at(m.mesh, {2, 2, 2})}};
    m.input.vertices[middle].z = m.mesh.vertices[middle].z = 1 + beside;
    EXPECT_EQ(failures(m, "input segments"), beside == 0 ? 0u : 1u);
  }
}

TEST(Verify, AFacetWithAVertexWithinItMustHaveThatVertex) {
  MeshedInput m = cube_in_five();
  m.input.vertices.push_back({0.5, 0.25, 0});
  m.input.polygon_facets.erase(m.input.polygon_facets.begin());  // that with z = 0
  for (const auto& [a, b] : {std::array{0u, 2u}, {2u, 3u}, {3u, 1u}, {1u, 0u}}) m.input.triangles.push_back({a, b, 8});
  EXPECT_EQ(failures(m, "input vertices"), 1u);
  EXPECT_GT(failures(m, "input facets"), 0u);
}

TEST(Verify, TrianglesOfAFacetMayBePassedInEitherDirection) {
  MeshedInput m = cube_in_five();
  m.input.polygon_facets.erase(m.input.polygon_facets.begin());  // that with z = 0
  for (const bool turned : {false, true}) {
    m.input.triangles = {{0, 1, 3}, {0, 3, 2}};  // the mesh has the other diagonal
    if (turned) std::swap(m.input.triangles[1][1], m.input.triangles[1][2]);
    expect_ok(m);
  }
}

TEST(Verify, AFaceThatIsTurnedOverInItsFacetIsFound) {
  MeshedInput coarse = cube_of(2);
  coarse.input = unit_cube();
  for (Point3& p : coarse.input.vertices) p = 2 * p;
  expect_ok(coarse);
  // Across an edge of the facet's triangles, and in its plane.
  coarse.mesh.vertices[vertex_at(coarse.mesh, {1, 1, 0})] = {1.9, 0.5, 0};
  EXPECT_GT(failures(coarse, "positive orientation"), 0u);
  EXPECT_GT(failures(coarse, "input facets"), 0u);
}

/// The faces of the boundary with markers by their plane, which are those of the facets.
MeshedInput cube_with_markers() {
  MeshedInput m = cube();
  m.mesh.faces = m.input.triangles;
  for (const auto& [a, b, c] : m.input.triangles) {
    const Point3 sum = m.input.vertices[a] + m.input.vertices[b] + m.input.vertices[c];
    const auto axis = [](double s) { return s == 0 ? 1 : s == 9 ? 2 : 0; };
    m.input.triangle_markers.push_back(axis(sum.x) + 3 * axis(sum.y) + 9 * axis(sum.z));
  }
  m.mesh.face_markers = m.input.triangle_markers;
  return m;
}

TEST(Verify, EachFaceHasTheMarkerOfItsFacet) {
  MeshedInput m = cube_with_markers();
  expect_ok(m);
  auto& markers = m.mesh.face_markers;
  const std::vector<int> right = markers;
  std::rotate(markers.begin(), markers.begin() + 1, markers.end());
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < markers.size(); ++i) wrong += markers[i] != right[i];
  EXPECT_EQ(failures(m, "face markers"), wrong);
}

TEST(Verify, AFaceThatIsListedTwiceIsFound) {
  MeshedInput m = cube_with_markers();
  m.mesh.faces.push_back(m.mesh.faces[4]);
  m.mesh.face_markers.push_back(m.mesh.face_markers[4]);
  EXPECT_EQ(failures(m, "listed faces"), 1u);
}

TEST(Verify, CosphericalVerticesAreLocallyDelaunay) {
  MeshedInput m = cube();
  m.mesh.constrained_delaunay = true;
  EXPECT_EQ(failures(m, "locally Delaunay faces"), 0u);
  EXPECT_EQ(failures(m, "locally Delaunay without rounding"), 0u);
}

TEST(Verify, RoundingExplainsNoMoreThanItself) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const auto transform = [&](const Point3& p) { return scale * rotated(p); };
    MeshedInput m = make_grid_mesh({3, 3, 3}, everywhere, false, transform);
    m.mesh.constrained_delaunay = true;
    expect_ok(m);
    const std::uint32_t inner = vertex_at(m.mesh, transform({1, 1, 1}));
    for (const double move : {1e-12, 1e-7}) {  // the rounding is about 1e-9
      MeshedInput moved = m;
      moved.mesh.vertices[inner].x += move * scale;
      moved.input.vertices[inner] = moved.mesh.vertices[inner];
      EXPECT_EQ(failures(moved, "locally Delaunay faces") > 0, move > 1e-9) << scale;
    }
  }
}

}  // namespace
}  // namespace ccdt
