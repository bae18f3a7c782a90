#include <gtest/gtest.h>

#include <utility>

#include "bench/tests/verify_cases.h"
#include "bench/verify/crossings.h"

namespace ccdt {
namespace {

constexpr verify::VerifyOptions own = {.surface = verify::VerifyOptions::Surface::own};

/// A mesh as Mesh_3 makes: near to the input, with none of its vertices.
MeshedInput approximated(MeshedInput m) {
  for (Point3& p : m.mesh.vertices) p = 0.997 * p + Point3{0.001, 0.002, 0.0015};
  return m;
}

void append(const mesh::TetMesh& other, const Point3& moved, mesh::TetMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Point3& p : other.vertices) mesh.vertices.push_back(p + moved);
  for (auto tet : other.tetrahedra) {
    for (std::uint32_t& v : tet) v += first;
    mesh.tetrahedra.push_back(tet);
    mesh.regions.push_back(0);
  }
}

TEST(VerifyOwnSurface, AnApproximationIsRightOnlyIfTheSurfaceMayBeAnother) {
  for (const MeshedInput& m : {approximated(cube()), approximated(two_regions()), approximated(plate()),
                               approximated(make_grid_mesh({3, 3, 3}, around_a_hole, false, rotated))}) {
    EXPECT_FALSE(verify::verify(m.input, m.mesh).ok());
    expect_ok(m, own);
  }
}

TEST(VerifyOwnSurface, AMeshOfTheInputsSurfaceIsRightToo) {
  expect_ok(cube(), own);
  expect_ok(two_regions(), own);
}

TEST(VerifyOwnSurface, VolumesOfBothAreStated) {
  const MeshedInput m = approximated(cube());
  const verify::Verification v = verify::verify(m.input, m.mesh, own);
  EXPECT_NEAR(v.input_volume, 27, 1e-9);
  EXPECT_NEAR(v.mesh_volume, 27 * 0.997 * 0.997 * 0.997, 1e-9);
}

TEST(VerifyOwnSurface, AnInvertedOrRepeatedTetrahedronIsFound) {
  MeshedInput m = approximated(cube());
  std::swap(m.mesh.tetrahedra[7][0], m.mesh.tetrahedra[7][1]);
  expect_failure(m, "positive orientation", own);
  m = approximated(cube());
  m.mesh.tetrahedra.push_back(m.mesh.tetrahedra[20]);
  m.mesh.regions.push_back(0);
  expect_failure(m, "faces of one or two tetrahedra", own);
}

TEST(VerifyOwnSurface, MeshesThatOverlapAreFound) {
  const MeshedInput large = cube();
  const MeshedInput small = make_grid_mesh({1, 1, 1}, everywhere, false, unmoved);
  const auto with_small_one = [&](const Point3& moved) {
    MeshedInput m = large;
    append(small.mesh, moved, m.mesh);
    return m;
  };
  expect_failure(with_small_one({0.9, 1.1, 1.2}), "boundary that encloses the tetrahedra once", own);
  expect_failure(with_small_one({2.6, 1.1, 1.2}), "boundary without crossings", own);
  expect_ok(with_small_one({5, 5, 5}), own);
}

/// Two triangles. The second has some of the vertices of the first.
std::size_t crossings(const std::array<std::uint32_t, 3>& other) {
  plc::InputPlc plc;
  plc.vertices = {{0, 0, 0},  {4, 0, 0}, {0, 4, 0},                        // the first triangle
                  {1, 1, -1}, {1, 1, 1}, {3, 3, 5}, {1, 1, 0}, {4, 5, 0},  // below, above, away; on it, beside it
                  {9, 9, -1}, {9, 9, 1}};                                  // far away, below and above
  plc.triangles = {{0, 1, 2}, other};
  return verify::find_crossings(plc).size();
}

TEST(Crossings, AreFoundOfTrianglesThatShareAnyNumberOfVertices) {
  EXPECT_EQ(crossings({3, 4, 5}), 1u);
  EXPECT_EQ(crossings({4, 5, 7}), 0u);
  EXPECT_EQ(crossings({6, 4, 5}), 1u) << "it touches";
  EXPECT_EQ(crossings({0, 3, 4}), 1u);
  EXPECT_EQ(crossings({0, 8, 9}), 1u) << "it cuts the opposite edge";
  EXPECT_EQ(crossings({0, 4, 5}), 0u);
  EXPECT_EQ(crossings({0, 6, 7}), 1u) << "in one plane";
  EXPECT_EQ(crossings({0, 1, 4}), 0u);
  EXPECT_EQ(crossings({1, 0, 6}), 1u) << "on one side of the edge";
  EXPECT_EQ(crossings({1, 2, 7}), 0u) << "on the other side of the edge";
  EXPECT_EQ(crossings({2, 0, 1}), 1u);
}

TEST(VerifyOwnSurface, AMeshWithoutTetrahedraIsWrong) {
  MeshedInput m = cube();
  m.mesh.tetrahedra.clear();
  m.mesh.regions.clear();
  EXPECT_FALSE(verify::verify(m.input, m.mesh, own).ok());
}

}  // namespace
}  // namespace ccdt
