#include "bench/verify/verify.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/tests/grid_mesh.h"
#include "bench/verify/print.h"

namespace ccdt {
namespace {

std::string all_lines(const Verification& verification) {
  std::string s;
  for (const std::string& line : describe(verification)) s += line + "\n";
  return s;
}

const Check& check_named(const Verification& verification, const std::string& name) {
  const auto found = std::find_if(verification.checks.begin(), verification.checks.end(),
                                  [&](const Check& c) { return c.name == name; });
  if (found == verification.checks.end()) throw std::runtime_error("no check is called " + name);
  return *found;
}

void expect_ok(const MeshedInput& m, const VerifyOptions& options = {}) {
  const Verification v = verify(m.input, m.mesh, options);
  EXPECT_TRUE(v.ok()) << all_lines(v);
}

/// The check of that name fails, and says where.
void expect_failure(const MeshedInput& m, const std::string& name, const VerifyOptions& options = {}) {
  const Verification v = verify(m.input, m.mesh, options);
  EXPECT_FALSE(v.ok());
  const Check& check = check_named(v, name);
  EXPECT_GT(check.failed, 0u) << all_lines(v);
  EXPECT_FALSE(check.examples.empty());
}

int everywhere(int, int, int) {
  return 0;
}
int left_and_right(int i, int, int) {
  return i < 2 ? 1 : 2;
}
int around_a_hole(int i, int j, int k) {
  return i == 1 && j == 1 && k == 1 ? outside : 0;
}

MeshedInput cube() {
  return make_grid_mesh({3, 3, 3}, everywhere, false, unmoved);
}

MeshedInput two_regions(bool turned = false, const Transform& transform = unmoved) {
  MeshedInput m = make_grid_mesh({4, 3, 3}, left_and_right, turned, transform);
  m.input.inside = InputPlc::Inside::seeds;
  m.input.regions = {{transform({0.4, 0.3, 0.6}), 1, 0}, {transform({3.4, 0.3, 0.6}), 2, 0}};
  return m;
}

std::uint32_t vertex_at(const TetMesh& mesh, const Point3& p) {
  const auto found = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
  return static_cast<std::uint32_t>(found - mesh.vertices.begin());
}

/// The unit cube as six quadrilaterals.
InputPlc unit_cube() {
  InputPlc input;
  for (int i = 0; i < 8; ++i) input.vertices.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  for (const auto& q : std::vector<std::vector<std::uint32_t>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    PolygonFacet facet;
    facet.polygons = {q};
    facet.number = static_cast<std::uint32_t>(input.polygon_facets.size());
    input.polygon_facets.push_back(facet);
  }
  return input;
}

MeshedInput cube_in_five() {
  MeshedInput m{unit_cube(), {}};
  m.mesh.vertices = m.input.vertices;
  m.mesh.tetrahedra = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
  m.mesh.regions.assign(5, 0);
  return m;
}

/// A triangle and two points far above and below it: two tetrahedra are Delaunay, three around the axis are not.
MeshedInput bipyramid(bool delaunay) {
  MeshedInput m;
  m.input.vertices = {{1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, {0, 0, 2}, {0, 0, -2}};
  m.input.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  m.mesh.vertices = m.input.vertices;
  if (delaunay)
    m.mesh.tetrahedra = {{0, 1, 2, 3}, {1, 0, 2, 4}};
  else
    m.mesh.tetrahedra = {{4, 0, 1, 3}, {4, 1, 2, 3}, {4, 2, 0, 3}};
  m.mesh.regions.assign(m.mesh.tetrahedra.size(), 0);
  m.mesh.constrained_delaunay = true;
  return m;
}

/// A plate with a square hole through it; its top and bottom are polygons with holes.
MeshedInput plate() {
  MeshedInput m = make_grid_mesh(
      {3, 3, 1}, [](int i, int j, int) { return i == 1 && j == 1 ? outside : 0; }, false, unmoved);
  m.input.inside = InputPlc::Inside::seeds;
  m.input.triangles.clear();
  const auto facet = [&](std::vector<std::vector<Point3>> loops, std::vector<Point3> holes) {
    PolygonFacet f;
    for (const auto& loop : loops) {
      f.polygons.emplace_back();
      for (const Point3& p : loop) f.polygons.back().push_back(vertex_at(m.mesh, p));
    }
    f.holes = std::move(holes);
    f.number = static_cast<std::uint32_t>(m.input.polygon_facets.size());
    m.input.polygon_facets.push_back(f);
  };
  for (const double z : {0.0, 1.0})
    facet({{{0, 0, z}, {3, 0, z}, {3, 3, z}, {0, 3, z}}, {{1, 1, z}, {2, 1, z}, {2, 2, z}, {1, 2, z}}},
          {{1.5, 1.5, z}});
  for (const auto& [low, high] : {std::pair{0.0, 3.0}, std::pair{1.0, 2.0}})
    for (const double at : {low, high}) {
      facet({{{low, at, 0}, {high, at, 0}, {high, at, 1}, {low, at, 1}}}, {});
      facet({{{at, low, 0}, {at, high, 0}, {at, high, 1}, {at, low, 1}}}, {});
    }
  return m;
}

TEST(Verify, ACubeInFiveTetrahedraIsRight) {
  const MeshedInput m = cube_in_five();
  expect_ok(m);
  const Verification v = verify(m.input, m.mesh);
  EXPECT_DOUBLE_EQ(v.mesh_volume, 1);
  EXPECT_DOUBLE_EQ(v.input_volume, 1);
  EXPECT_EQ(check_named(v, "input segments").checked, 12u);
  EXPECT_EQ(check_named(v, "input facets").checked, 6u);
  EXPECT_EQ(check_named(v, "boundary faces on input facets").checked, 12u);
}

TEST(Verify, GridsAreRightWithEitherDiagonalAndRotated) {
  for (const bool turned : {false, true})
    for (const Transform& transform : {Transform(unmoved), Transform(rotated)}) {
      expect_ok(make_grid_mesh({4, 4, 4}, everywhere, turned, transform));
      expect_ok(make_grid_mesh({3, 3, 3}, around_a_hole, turned, transform));
      expect_ok(two_regions(turned, transform));
    }
}

TEST(Verify, APrismIsRight) {
  MeshedInput m;
  m.input.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  m.input.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  m.mesh.vertices = m.input.vertices;
  m.mesh.tetrahedra = {{0, 1, 2, 3}, {1, 4, 2, 3}, {4, 5, 2, 3}};
  m.mesh.regions.assign(3, 0);
  expect_ok(m);
}

TEST(Verify, NestedShellsAlternate) {
  const auto shell = [](int i, int j, int k) {
    const int depth = std::min({i, j, k, 6 - i, 6 - j, 6 - k});
    return depth == 1 || depth == 2 ? outside : 0;
  };
  expect_ok(make_grid_mesh({7, 7, 7}, shell, true, rotated));
}

TEST(Verify, CubesThatShareAFaceOfASurfaceAreBothInside) {
  MeshedInput m = two_regions(true, rotated);
  m.input.inside = InputPlc::Inside::even_odd;
  m.input.regions.clear();
  expect_ok(m);
}

TEST(Verify, APlateOfPolygonsWithHolesIsRight) {
  expect_ok(plate());
}

TEST(Verify, AVertexListedForEachTriangleIsOne) {
  MeshedInput m = cube();
  std::vector<Point3> soup;
  for (auto& triangle : m.input.triangles)
    for (std::uint32_t& v : triangle) {
      soup.push_back(m.input.vertices[v]);
      v = static_cast<std::uint32_t>(soup.size() - 1);
    }
  m.input.vertices = soup;
  expect_ok(m);
}

TEST(Verify, CoordinatesMayBeRounded) {
  MeshedInput m = make_grid_mesh({4, 4, 4}, everywhere, true, rotated);
  for (std::size_t i = 0; i < m.mesh.vertices.size(); ++i) m.mesh.vertices[i].x += (i % 3 - 1.0) * 4e-10;
  expect_ok(m);
}

TEST(Verify, AnInvertedTetrahedronIsFound) {
  MeshedInput m = cube();
  std::swap(m.mesh.tetrahedra[7][0], m.mesh.tetrahedra[7][1]);
  expect_failure(m, "positive orientation");
  expect_failure(m, "faces of one or two tetrahedra");
}

TEST(Verify, AnyRemovedTetrahedronIsFound) {
  const MeshedInput whole = cube();
  for (std::size_t t = 0; t < whole.mesh.tetrahedra.size(); t += 5) {
    MeshedInput m = whole;
    m.mesh.tetrahedra.erase(m.mesh.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
    m.mesh.regions.pop_back();
    expect_failure(m, "boundary faces on input facets");
    expect_failure(m, "volume");
  }
}

TEST(Verify, ADuplicatedTetrahedronIsFound) {
  MeshedInput m = cube();
  m.mesh.tetrahedra.push_back(m.mesh.tetrahedra[20]);
  m.mesh.regions.push_back(0);
  expect_failure(m, "faces of one or two tetrahedra");
}

TEST(Verify, TwoMeshesOfOneCubeAreTooMany) {
  MeshedInput m = cube_in_five();
  const MeshedInput other = make_grid_mesh({1, 1, 1}, everywhere, false, unmoved);
  for (auto tet : other.mesh.tetrahedra) {
    for (std::uint32_t& v : tet) v = vertex_at(m.mesh, other.mesh.vertices[v]);
    m.mesh.tetrahedra.push_back(tet);
    m.mesh.regions.push_back(0);
  }
  expect_failure(m, "boundary faces on input facets");
  expect_failure(m, "volume");
}

TEST(Verify, AMovedVertexIsFound) {
  for (const Point3& at : {Point3{0, 0, 0}, Point3{1, 2, 0}, Point3{0, 0, 1}}) {
    MeshedInput m = cube();
    m.mesh.vertices[vertex_at(m.mesh, at)].z += 1e-6;
    expect_failure(m, "input vertices");
    expect_failure(m, "input facets");
  }
}

TEST(Verify, AVertexOffItsFacetIsFoundEvenIfItIsNotOfTheInput) {
  MeshedInput m = make_grid_mesh({2, 2, 2}, everywhere, false, unmoved);
  MeshedInput coarse = m;
  coarse.input = unit_cube();
  for (Point3& p : coarse.input.vertices) p = 2 * p;
  expect_ok(coarse);
  coarse.mesh.vertices[vertex_at(m.mesh, {1, 1, 0})].z -= 1e-6;
  expect_failure(coarse, "input facets");
  coarse.mesh.vertices = m.mesh.vertices;
  coarse.mesh.vertices[vertex_at(m.mesh, {1, 0, 0})].z -= 1e-6;
  expect_failure(coarse, "input segments");
}

TEST(Verify, AMissingInputVertexIsFoundIfItIsInside) {
  MeshedInput m = cube();
  m.input.vertices.push_back({-1, 0.5, 0.5});
  expect_ok(m);
  m.input.vertices.push_back({0.5, 0.25, 0.25});
  expect_failure(m, "input vertices");
  m = cube();
  m.input.vertices.push_back({0.5, 0.25, 0});
  expect_failure(m, "input vertices");
}

TEST(Verify, AMissingSegmentIsFound) {
  MeshedInput m = make_grid_mesh({4, 3, 3}, everywhere, false, unmoved);
  const auto segment = [&](const Point3& a, const Point3& b) {
    m.input.segments.push_back({vertex_at(m.mesh, a), vertex_at(m.mesh, b)});
  };
  segment({0, 1, 1}, {4, 1, 1});
  segment({0, 0, 0}, {3, 3, 3});
  expect_ok(m);
  segment({1, 1, 1}, {2, 3, 1});
  expect_failure(m, "input segments");
}

TEST(Verify, AFlippedInteriorFaceIsFound) {
  MeshedInput m = two_regions();
  auto& tets = m.mesh.tetrahedra;
  const auto is_on_interface = [&](std::uint32_t v) { return m.mesh.vertices[v].x == 2; };
  const auto touches = [&](const auto& tet) { return std::count_if(tet.begin(), tet.end(), is_on_interface) == 3; };
  // The apexes of two tetrahedra at one face of the interface; three around their common line replace them.
  for (std::size_t i = 0; i < tets.size(); ++i)
    for (std::size_t j = i + 1; j < tets.size(); ++j) {
      if (!touches(tets[i]) || !touches(tets[j])) continue;
      std::vector<std::uint32_t> face;
      for (const std::uint32_t v : tets[i])
        if (is_on_interface(v) && std::find(tets[j].begin(), tets[j].end(), v) != tets[j].end()) face.push_back(v);
      if (face.size() != 3) continue;
      const auto apex = [&](const auto& tet) { return *std::find_if_not(tet.begin(), tet.end(), is_on_interface); };
      const std::uint32_t a = apex(tets[i]), b = apex(tets[j]);
      tets.erase(tets.begin() + static_cast<std::ptrdiff_t>(j));
      tets.erase(tets.begin() + static_cast<std::ptrdiff_t>(i));
      for (std::size_t k = 0; k < 3; ++k) tets.push_back({a, face[k], face[(k + 1) % 3], b});
      m.mesh.regions.push_back(1);
      expect_failure(m, "input facets");
      return;
    }
  FAIL() << "no face found";
}

TEST(Verify, AWrongRegionIsFound) {
  MeshedInput m = two_regions();
  expect_ok(m);
  m.mesh.regions[3] = 2;
  expect_failure(m, "regions");
  m = two_regions();
  for (int& r : m.mesh.regions) r = 3 - r;
  expect_failure(m, "regions");
  m = two_regions();
  m.input.regions.clear();
  expect_ok(m);
  m.mesh.regions[3] = 2;
  expect_failure(m, "regions");
}

TEST(Verify, AFilledHoleIsFound) {
  MeshedInput m = cube();
  m.input.triangles = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved).input.triangles;
  const MeshedInput hollow = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved);
  m.input = hollow.input;
  expect_failure(m, "tetrahedra in the domain");
  expect_failure(m, "volume");
  m.input.inside = InputPlc::Inside::seeds;
  expect_ok(m);
  m.input.holes = {{1.5, 1.4, 1.3}};
  expect_failure(m, "holes");
  m.mesh = hollow.mesh;
  expect_ok(m);
}

TEST(Verify, AMissingRegionIsFound) {
  MeshedInput m = two_regions();
  const MeshedInput half = make_grid_mesh({2, 3, 3}, everywhere, false, unmoved);
  m.mesh = half.mesh;
  for (int& r : m.mesh.regions) r = 1;
  expect_failure(m, "input facets");
  expect_failure(m, "input vertices");
}

TEST(Verify, ADanglingFacetMustBeThere) {
  for (const bool turned : {false, true}) {
    MeshedInput m = make_grid_mesh({3, 3, 3}, everywhere, turned, rotated);
    const auto at = [&](double x, double y, double z) { return vertex_at(m.mesh, rotated({x, y, z})); };
    m.input.triangles.push_back({at(1, 1, 1), at(2, 1, 1), at(2, 2, 1)});
    m.input.triangles.push_back({at(1, 1, 1), at(2, 2, 1), at(1, 2, 1)});
    expect_ok(m);
    m.input.triangles.push_back({at(1, 1, 2), at(2, 1, 2), at(1, 2, 2)});  // the mesh has the other diagonal
    expect_failure(m, "input facets");
    expect_failure(m, "input segments");
  }
}

TEST(Verify, APlateWithItsHoleClosedAtBothEndsIsAnotherDomain) {
  MeshedInput m = plate();
  m.input.polygon_facets[0].holes.clear();
  expect_ok(m);  // a membrane at one end has the outside on both sides
  m.input.polygon_facets[1].holes.clear();
  expect_failure(m, "input facets");
  expect_failure(m, "volume");
  m.input.holes = {{1.5, 1.4, 0.3}};
  expect_ok(m);
}

/// An octahedron with a square across it that is flat only within the tolerance: a flat tetrahedron lies in the square,
/// between the two tetrahedra above one of its diagonals and the two below the other.
MeshedInput octahedron_with_flat_tetrahedron(double thickness) {
  MeshedInput m;
  m.input.inside = InputPlc::Inside::seeds;
  m.input.vertices = {{1, 0, thickness}, {0, 1, 0}, {-1, 0, thickness}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    m.input.triangles.push_back({i, (i + 1) % 4, 4});
    m.input.triangles.push_back({(i + 1) % 4, i, 5});
  }
  m.input.regions = {{{0.1, 0.1, 0.5}, 7, 0}, {{0.1, 0.1, -0.5}, 9, 0}};
  m.mesh.vertices = m.input.vertices;
  m.mesh.tetrahedra = {{0, 1, 2, 4}, {0, 2, 3, 4}, {1, 0, 3, 5}, {2, 1, 3, 5}, {0, 2, 1, 3}};
  m.mesh.regions = {7, 7, 9, 9, 9};
  return m;
}

TEST(Verify, AFlatTetrahedronMayLieInAnInteriorFacet) {
  MeshedInput m = octahedron_with_flat_tetrahedron(1e-9);
  m.input.triangles.push_back({0, 1, 2});
  m.input.triangles.push_back({0, 3, 2});
  expect_ok(m);
  m.input.triangles.resize(8);
  m.input.triangles.push_back({1, 2, 3});
  m.input.triangles.push_back({0, 1, 3});
  m.mesh.regions.back() = 7;  // these triangles are the ones below it
  expect_ok(m);
  m.input.triangles.resize(8);
  m.input.polygon_facets.push_back({{{3, 2, 1, 0}}, {}, 0, 8});
  expect_ok(m);
  m.mesh.regions = {7, 9, 9, 9, 9};
  expect_failure(m, "regions");
}

TEST(Verify, AThickTetrahedronMayNotLieInAFacet) {
  MeshedInput m = octahedron_with_flat_tetrahedron(1e-6);
  m.input.polygon_facets.push_back({{{0, 1, 2, 3}}, {}, 0, 8});
  expect_failure(m, "input facets");
}

TEST(Verify, ANonDelaunayFlipIsFound) {
  expect_ok(bipyramid(true));
  expect_failure(bipyramid(false), "locally Delaunay faces");
  MeshedInput m = bipyramid(false);
  m.mesh.constrained_delaunay = false;
  expect_ok(m);
  VerifyOptions options;
  options.delaunay = VerifyOptions::Delaunay::yes;
  expect_failure(m, "locally Delaunay faces", options);
  // A face that is asked for need not be Delaunay; one that is in the way of the other mesh need not either.
  m = bipyramid(true);
  m.input.vertices[3].z = m.mesh.vertices[3].z = 0.1;
  m.input.vertices[4].z = m.mesh.vertices[4].z = -0.1;
  expect_failure(m, "locally Delaunay faces");
  m.input.triangles.push_back({0, 1, 2});
  expect_ok(m);
}

TEST(Verify, WhatRoundingExplainsIsNotHeldAgainstTheMesh) {
  MeshedInput m =
      make_grid_mesh({3, 3, 3}, everywhere, false, rotated);  // five cospherical points, but for the last bits
  m.mesh.constrained_delaunay = true;
  expect_ok(m);
  const Verification v = verify(m.input, m.mesh);
  EXPECT_GT(check_named(v, "locally Delaunay without rounding").failed, 0u);
  const std::uint32_t inner = vertex_at(m.mesh, rotated({1, 1, 1}));
  m.mesh.vertices[inner].x += 1e-6;
  m.input.vertices[inner].x += 1e-6;
  expect_failure(m, "locally Delaunay faces");
}

TEST(Verify, AHangingVertexIsFound) {
  MeshedInput m = cube();
  const std::array<std::uint32_t, 4> tet = m.mesh.tetrahedra[80];
  const std::uint32_t middle = static_cast<std::uint32_t>(m.mesh.vertices.size());
  m.mesh.vertices.push_back(0.5 * (m.mesh.vertices[tet[0]] + m.mesh.vertices[tet[3]]));
  m.mesh.tetrahedra[80][0] = middle;
  m.mesh.tetrahedra.push_back({tet[0], tet[1], tet[2], middle});
  m.mesh.regions.push_back(0);
  expect_failure(m, "boundary faces on input facets");
}

TEST(Verify, BrokenArraysAreFoundAndNothingElseIsAsked) {
  MeshedInput m = cube();
  m.mesh.tetrahedra[3][2] = 1000000;
  expect_failure(m, "valid elements");
  m = cube();
  m.mesh.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  expect_failure(m, "finite coordinates");
  m = cube();
  m.mesh.regions.pop_back();
  expect_failure(m, "valid elements");
  m.mesh = {};
  expect_failure(m, "valid elements");
}

TEST(Verify, TwoVerticesInOnePlaceAreFound) {
  MeshedInput m = cube();
  const std::uint32_t v = vertex_at(m.mesh, {1, 1, 1});
  m.mesh.vertices.push_back(m.mesh.vertices[v]);
  for (std::size_t t = 0; t < 40; ++t)
    std::replace(m.mesh.tetrahedra[t].begin(), m.mesh.tetrahedra[t].end(), v, v + 1000);
  for (auto& tet : m.mesh.tetrahedra)
    std::replace(tet.begin(), tet.end(), v + 1000, static_cast<std::uint32_t>(m.mesh.vertices.size() - 1));
  expect_failure(m, "distinct vertices");
}

TEST(Verify, TheDescriptionSaysWhatFailedAndWhere) {
  MeshedInput m = cube();
  EXPECT_EQ(describe(verify(m.input, m.mesh)).back(), "the mesh is right");
  std::swap(m.mesh.tetrahedra[0][0], m.mesh.tetrahedra[0][1]);
  const std::string lines = all_lines(verify(m.input, m.mesh));
  EXPECT_NE(lines.find("FAILED  positive orientation"), std::string::npos) << lines;
  EXPECT_NE(lines.find("tetrahedron 0: (1, 0, 0) (0, 0, 0)"), std::string::npos) << lines;
  EXPECT_NE(lines.find("the mesh is WRONG"), std::string::npos) << lines;
}

}  // namespace
}  // namespace ccdt
