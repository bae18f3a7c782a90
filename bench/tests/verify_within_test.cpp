#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bench/tests/verify_cases.h"

namespace ccdt {
namespace {

verify::VerifyOptions within(double distance) {
  return {.surface = verify::VerifyOptions::Surface::own, .within = distance};
}

/// A mesh with none of the input's vertices: each moves by 0.002 to 0.0124.
MeshedInput moved_a_little(MeshedInput m) {
  for (Point3& p : m.mesh.vertices) p = 0.997 * p + Point3{0.002, 0.002, 0.002};
  return m;
}

/// All tetrahedra for which a vertex is in this box go.
void remove_in(const Point3& low, const Point3& high, mesh::TetMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    Point3 center;
    for (const std::uint32_t v : mesh.tetrahedra[t]) center = center + 0.25 * mesh.vertices[v];
    const bool is_in = center.x > low.x && center.y > low.y && center.z > low.z && center.x < high.x &&
                       center.y < high.y && center.z < high.z;
    if (is_in) continue;
    mesh.regions[kept] = mesh.regions[t];
    mesh.tetrahedra[kept++] = mesh.tetrahedra[t];
  }
  mesh.tetrahedra.resize(kept);
  mesh.regions.resize(kept);
}

constexpr const char* from_mesh = "distance of the mesh from the input";
constexpr const char* from_input = "distance of the input from the mesh";

TEST(VerifyWithin, AMeshNearTheInputIsRightUpToItsDistance) {
  for (const MeshedInput& m : {moved_a_little(cube()), moved_a_little(two_regions()), moved_a_little(plate()),
                               moved_a_little(make_grid_mesh({3, 3, 3}, around_a_hole, false, rotated))}) {
    expect_ok(m, within(0.02));
    EXPECT_FALSE(verify::verify(m.input, m.mesh, within(0.001)).ok());
  }
  const MeshedInput m = moved_a_little(cube());  // the corner (3, 3, 3) moves by (-0.007, -0.007, -0.007)
  expect_ok(m, within(0.0122));
  expect_failure(m, from_input, within(0.0121));
  expect_failure(m, from_mesh, within(0.0069));
}

TEST(VerifyWithin, TheInputsOwnSurfaceIsRightAtOnce) {
  expect_ok(cube(), within(1e-9));
  expect_ok(two_regions(), within(1e-9));
}

TEST(VerifyWithin, DistancesAreStated) {
  const MeshedInput m = moved_a_little(cube());
  const auto distances = verify::verify(m.input, m.mesh, within(0.02)).distances;
  ASSERT_TRUE(distances);
  EXPECT_NEAR(distances->from_input, 0.007 * std::sqrt(3.0), 4e-4);
  EXPECT_NEAR(distances->to_input, 0.007, 3e-4);
  EXPECT_FALSE(verify::verify(m.input, m.mesh, {.surface = verify::VerifyOptions::Surface::own}).distances);
}

TEST(VerifyWithin, AFilledHoleIsFoundByItsDistanceAndByTheSpaces) {
  MeshedInput m = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved);
  m.mesh = cube().mesh;
  expect_failure(m, from_input, within(0.3));
  expect_failure(m, "spaces outside", within(0.6));
  m.mesh = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved).mesh;
  expect_ok(m, within(1e-6));
}

TEST(VerifyWithin, AHoleThatTheInputDoesNotHaveIsFound) {
  MeshedInput m = cube();
  m.mesh = make_grid_mesh({3, 3, 3}, around_a_hole, false, unmoved).mesh;
  expect_failure(m, from_mesh, within(0.3));
  expect_failure(m, "spaces outside", within(5));
}

TEST(VerifyWithin, ALostPartIsFound) {
  MeshedInput m = two_regions();
  remove_in({2, -1, -1}, {5, 5, 5}, m.mesh);
  expect_failure(m, from_input, within(0.1));
  expect_failure(m, "parts of the domain", within(10));
  expect_failure(m, "volume", within(0.1));
}

TEST(VerifyWithin, ALostWallBetweenTwoRegionsIsFound) {
  MeshedInput m = two_regions();
  m.mesh.regions.assign(m.mesh.tetrahedra.size(), 1);
  expect_failure(m, from_input, within(0.1));
  expect_failure(m, "parts of the domain", within(10));
}

TEST(VerifyWithin, ABoundaryThatCrossesItselfIsFound) {
  MeshedInput m = cube();
  const MeshedInput small = make_grid_mesh({1, 1, 1}, everywhere, false, unmoved);
  const auto first = static_cast<std::uint32_t>(m.mesh.vertices.size());
  for (const Point3& p : small.mesh.vertices) m.mesh.vertices.push_back(p + Point3{2.6, 1.1, 1.2});
  for (auto tet : small.mesh.tetrahedra) {
    for (std::uint32_t& v : tet) v += first;
    m.mesh.tetrahedra.push_back(tet);
    m.mesh.regions.push_back(0);
  }
  expect_failure(m, "boundary without crossings", within(5));
}

TEST(VerifyWithin, FacetsOutsideOfTheDomainDoNotCount) {
  MeshedInput m = cube();
  const auto first = static_cast<std::uint32_t>(m.input.vertices.size());
  m.input.vertices.insert(m.input.vertices.end(), {{7, 0, 0}, {8, 0, 0}, {7, 1, 0}});
  m.input.triangles.push_back({first, first + 1, first + 2});
  m.input.inside = plc::InputPlc::Inside::seeds;
  expect_ok(m, within(1e-6));
}

TEST(VerifyWithin, ItHoldsForAnyUnit) {
  MeshedInput m = moved_a_little(cube());
  for (Point3& p : m.input.vertices) p = 1e70 * p;
  for (Point3& p : m.mesh.vertices) p = 1e70 * p;
  expect_ok(m, within(0.0122e70));
  EXPECT_FALSE(verify::verify(m.input, m.mesh, within(0.0121e70)).ok());
  EXPECT_NEAR(verify::verify(m.input, m.mesh, within(0.02e70)).distances->to_input, 0.007e70, 3e66);
}

}  // namespace
}  // namespace ccdt
