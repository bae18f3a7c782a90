#include "bench/verify/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/tests/verify_cases.h"

namespace ccdt {
namespace {

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

/// The cube with all its boundary faces listed, which have the markers of the input's facets.
MeshedInput cube_with_faces() {
  MeshedInput m = cube();
  m.input.triangle_markers.assign(m.input.triangles.size(), 7);
  m.mesh.faces = m.input.triangles;
  for (auto& face : m.mesh.faces)
    for (std::uint32_t& v : face) v = vertex_at(m.mesh, m.input.vertices[v]);
  m.mesh.face_markers.assign(m.mesh.faces.size(), 7);
  return m;
}

TEST(Verify, ListedFacesAreTheBoundary) {
  const MeshedInput whole = cube_with_faces();
  expect_ok(whole);
  MeshedInput m = whole;
  m.mesh.faces.pop_back();
  m.mesh.face_markers.pop_back();
  expect_failure(m, "listed faces");
  m = whole;
  m.mesh.faces.back() = m.mesh.faces.front();
  expect_failure(m, "listed faces");
  m = whole;
  std::swap(m.mesh.faces.back()[0], m.mesh.faces.front()[0]);
  expect_failure(m, "listed faces");
}

TEST(Verify, AWrongMarkerOfAListedFaceIsFound) {
  MeshedInput m = cube_with_faces();
  m.mesh.face_markers[3] = 8;
  expect_failure(m, "face markers");
  m.input.triangle_markers.clear();
  expect_ok(m);
}

TEST(Verify, MarkersThatTheMeshDoesNotHaveAreNotCompared) {
  const auto not_compared = [](const MeshedInput& m, const char* check) {
    const verify::Verification verification = verify::verify(m.input, m.mesh, tetrahedra_alone);
    EXPECT_TRUE(verification.ok()) << all_lines(verification);
    return check_named(verification, check).not_compared;
  };
  MeshedInput m = cube_with_faces();
  EXPECT_EQ(not_compared(m, "face markers"), "");
  m.mesh.face_markers.clear();
  EXPECT_NE(not_compared(m, "face markers"), "");
  m.input.triangle_markers.clear();
  EXPECT_EQ(not_compared(m, "face markers"), "") << "there is nothing to compare";
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

TEST(Verify, AVertexOffItsFacetIsFoundEvenIfTheInputDoesNotHaveIt) {
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

TEST(Verify, AFlippedInteriorFaceIsFound) {
  MeshedInput m = two_regions();
  auto& tets = m.mesh.tetrahedra;
  const auto is_on_interface = [&](std::uint32_t v) { return m.mesh.vertices[v].x == 2; };
  const auto touches = [&](const auto& tet) { return std::count_if(tet.begin(), tet.end(), is_on_interface) == 3; };
  // Replaces two tetrahedra with a common face in the interface by three around the line between their apexes.
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

TEST(Verify, ANonDelaunayFlipIsFound) {
  expect_ok(bipyramid(true));
  expect_failure(bipyramid(false), "locally Delaunay faces");
  MeshedInput m = bipyramid(false);
  m.mesh.constrained_delaunay = false;
  expect_ok(m);
  verify::VerifyOptions options;
  options.delaunay = verify::VerifyOptions::Delaunay::yes;
  expect_failure(m, "locally Delaunay faces", options);
  // A face that is a facet of the input need not be Delaunay.
  m = bipyramid(true);
  m.input.vertices[3].z = m.mesh.vertices[3].z = 0.1;
  m.input.vertices[4].z = m.mesh.vertices[4].z = -0.1;
  expect_failure(m, "locally Delaunay faces");
  m.input.triangles.push_back({0, 1, 2});
  expect_ok(m);
}

TEST(Verify, WhatRoundingExplainsIsNotHeldAgainstTheMesh) {
  MeshedInput m =
      make_grid_mesh({3, 3, 3}, everywhere, false, rotated);  // five cospherical points, except for the last bits
  m.mesh.constrained_delaunay = true;
  expect_ok(m);
  const verify::Verification v = verify::verify(m.input, m.mesh);
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

TEST(Verify, BrokenArraysAreFoundAndNothingElseIsChecked) {
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
  EXPECT_TRUE(verify::verify(m.input, m.mesh, tetrahedra_alone).ok());
  std::swap(m.mesh.tetrahedra[0][0], m.mesh.tetrahedra[0][1]);
  const verify::Verification wrong = verify::verify(m.input, m.mesh);
  EXPECT_FALSE(wrong.ok());
  const std::string lines = all_lines(wrong);
  EXPECT_NE(lines.find("positive orientation"), std::string::npos) << lines;
  EXPECT_NE(lines.find("tetrahedron 0: (1, 0, 0) (0, 0, 0)"), std::string::npos) << lines;
}

}  // namespace
}  // namespace ccdt
