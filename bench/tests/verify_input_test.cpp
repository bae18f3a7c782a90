#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "bench/tests/verify_cases.h"
#include "bench/verify/verify.h"

namespace ccdt {
namespace {

TEST(Verify, ACubeInFiveTetrahedraIsRight) {
  const MeshedInput m = cube_in_five();
  expect_ok(m);
  const verify::Verification v = verify::verify(m.input, m.mesh);
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

TEST(Verify, FlatFacetsMayBeBentByRoundingToSinglePrecision) {
  const Transform far_away = [](const Point3& p) {
    const Point3 q = rotated(p) + Point3{1000, -1000, 300};
    const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return Point3{rounded(q.x), rounded(q.y), rounded(q.z)};
  };
  for (const bool turned : {false, true}) {
    const MeshedInput m = make_grid_mesh({4, 4, 4}, everywhere, turned, far_away);
    expect_ok(m);
    EXPECT_EQ(verify::verify(m.input, m.mesh,
                             {.flatness = 1.01 * usual_flatness, .lists = verify::VerifyOptions::Lists::tetrahedra})
                  .ok(),
              !turned);
  }
}

TEST(Verify, APolygonThatRunsRoundSeveralTimesIsOneFacet) {
  MeshedInput m = cube_in_five();
  for (const bool there_and_back : {false, true}) {
    auto& polygon = m.input.polygon_facets[2].polygons[0];
    auto once = polygon;
    if (there_and_back) std::reverse(once.begin(), once.end());
    polygon.insert(polygon.end(), once.begin(), once.end());
    expect_ok(m);
  }
  EXPECT_DOUBLE_EQ(verify::verify(m.input, m.mesh, tetrahedra_alone).input_volume, 1);
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
  m.input.inside = plc::InputPlc::Inside::even_odd;
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

TEST(Verify, FacetsWithoutAreaAreNoPartOfTheSurface) {
  MeshedInput m = cube();
  const auto n = static_cast<std::uint32_t>(m.input.vertices.size());
  m.input.vertices.insert(m.input.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  m.input.triangles.insert(m.input.triangles.end(), {{n, n + 2, n + 1}, {n, n + 1, n + 1}});
  m.input.polygon_facets.push_back({.polygons = {{n, n + 1, n + 2, n + 3}}, .holes = {}});
  expect_ok(m);
}

TEST(Verify, CoordinatesMayBeRounded) {
  MeshedInput m = make_grid_mesh({4, 4, 4}, everywhere, true, rotated);
  for (std::size_t i = 0; i < m.mesh.vertices.size(); ++i) m.mesh.vertices[i].x += (i % 3 - 1.0) * 4e-10;
  expect_ok(m);
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

TEST(Verify, ASegmentMayPassAVertexWithinTheTolerance) {
  // Triangles in a plane, joined to a vertex above and one below. The segment from 0 to 1 passes vertex 2, from which
  // no edge goes to vertex 1.
  const double quantum = 0x1p-30;
  MeshedInput m;
  m.input.vertices = {{0, 0, 0},    {2, quantum, 0}, {0x1p-10, 0, 0}, {3, quantum, 0},
                      {0.5, -1, 0}, {0.5, 1, 0},     {1, 0, 1},       {1, 0, -1}};
  m.mesh.vertices = m.input.vertices;
  for (const auto& [a, b, c] :
       {std::array{0u, 3u, 1u}, {0u, 2u, 3u}, {0u, 1u, 5u}, {1u, 3u, 5u}, {0u, 4u, 2u}, {2u, 4u, 3u}}) {
    m.mesh.tetrahedra.insert(m.mesh.tetrahedra.end(), {{a, b, c, 6}, {b, a, c, 7}});
    m.mesh.regions.insert(m.mesh.regions.end(), 2, 0);
  }
  for (const auto& [a, b] : {std::array{0u, 4u}, {4u, 3u}, {3u, 5u}, {5u, 0u}})
    m.input.triangles.insert(m.input.triangles.end(), {{a, b, 6}, {b, a, 7}});
  m.input.segments = {{0, 1}};
  expect_ok(m);
  m.input.segments = {{2, 1}};
  expect_failure(m, "input segments");
}

TEST(Verify, AFilledHoleIsFound) {
  MeshedInput m = cube();
  m.input.triangles = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved).input.triangles;
  const MeshedInput hollow = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved);
  m.input = hollow.input;
  expect_failure(m, "tetrahedra in the domain");
  expect_failure(m, "volume");
  m.input.inside = plc::InputPlc::Inside::seeds;
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
  m.input.inside = plc::InputPlc::Inside::seeds;
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

TEST(Verify, AFlatTetrahedronInAnInteriorFacetMayBelongToEitherSide) {
  for (const bool seeds : {true, false})
    for (const bool other_diagonal : {true, false})
      for (const int region : {7, 9}) {
        MeshedInput m = octahedron_with_flat_tetrahedron(1e-9);
        m.input.triangles.push_back(other_diagonal ? std::array{1u, 2u, 3u} : std::array{0u, 1u, 2u});
        m.input.triangles.push_back(other_diagonal ? std::array{0u, 1u, 3u} : std::array{0u, 3u, 2u});
        if (!seeds) m.input.regions.clear();
        m.mesh.regions.back() = region;
        std::rotate(m.mesh.tetrahedra.begin(), m.mesh.tetrahedra.end() - 1, m.mesh.tetrahedra.end());  // it is first
        std::rotate(m.mesh.regions.begin(), m.mesh.regions.end() - 1, m.mesh.regions.end());
        expect_ok(m);
        m.mesh.regions.front() = 8;
        expect_failure(m, "regions");
        for (std::size_t t = 1; t < 5; ++t) {
          m.mesh.regions = {region, 7, 7, 9, 9};
          m.mesh.regions[t] = 16 - m.mesh.regions[t];
          expect_failure(m, "regions");
        }
      }
}

TEST(Verify, AThinTetrahedronBesideAFacetBelongsToItsSide) {
  MeshedInput m = octahedron_with_flat_tetrahedron(0);
  m.mesh.tetrahedra.pop_back();
  m.mesh.tetrahedra[2] = {2, 0, 3, 5};
  m.mesh.tetrahedra[3] = {0, 2, 1, 5};
  m.input.triangles.push_back({0, 1, 2});
  m.input.triangles.push_back({0, 3, 2});
  // A vertex a hair above the facet makes a tetrahedron of almost no volume, but not of vertices of the facet.
  m.mesh.vertices.push_back({0.1, 0.2, 1e-9});
  m.mesh.tetrahedra[0] = {0, 1, 2, 6};
  m.mesh.tetrahedra.insert(m.mesh.tetrahedra.end(), {{0, 1, 6, 4}, {1, 2, 6, 4}, {2, 0, 6, 4}});
  m.mesh.regions = {7, 7, 9, 9, 7, 7, 7};
  expect_ok(m);
  m.mesh.regions[0] = 9;
  expect_failure(m, "regions");
}

TEST(Verify, AThickTetrahedronMayNotLieInAFacet) {
  MeshedInput m = octahedron_with_flat_tetrahedron(1e-6);
  m.input.polygon_facets.push_back({{{0, 1, 2, 3}}, {}, 0, 8});
  expect_failure(m, "input facets");
}

}  // namespace
}  // namespace ccdt
