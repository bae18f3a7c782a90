#include "baselines/mesh_cleanup.h"

#include <gtest/gtest.h>

#include "baselines/tests/shapes.h"

namespace ccdt {
namespace {

/// Two tetrahedra that share the face 1 2 3.
TetMesh two_tetrahedra() {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.regions = {5, 6};
  return mesh;
}

TEST(KeepOddRegions, KeepsAllOfAMeshWithoutInnerFacets) {
  TetMesh mesh = two_tetrahedra();
  baselines::keep_odd_regions(mesh);
  EXPECT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 5u);
}

TEST(KeepOddRegions, DropsWhatLiesBetweenTheSurfaceAndItsConvexHull) {
  TetMesh mesh = two_tetrahedra();
  mesh.faces = {{1, 2, 3}, {1, 2, 4}, {2, 3, 4}, {1, 3, 4}};  // the second tetrahedron
  baselines::keep_odd_regions(mesh);
  EXPECT_EQ(mesh.regions, std::vector<int>{6});
  mesh = two_tetrahedra();
  mesh.faces = {{1, 2, 3}, {0, 1, 2}, {0, 2, 3}, {0, 1, 3}};
  baselines::keep_odd_regions(mesh);
  EXPECT_EQ(mesh.regions, std::vector<int>{5});
}

TEST(OrientPositively, TurnsAMeshThatIsInsideOut) {
  TetMesh mesh = two_tetrahedra();
  mesh.tetrahedra = {{1, 0, 2, 3}};
  baselines::orient_positively(mesh);
  EXPECT_EQ(mesh.tetrahedra[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
}

TEST(CountElements, TellsInputSteinerAndInteriorVerticesApart) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  TetMesh mesh = two_tetrahedra();
  mesh.faces = {{0, 1, 3}};
  const MeshCounts counts = baselines::count_elements(plc, mesh);
  EXPECT_EQ(counts.vertices, 5u);
  EXPECT_EQ(counts.steiner_vertices, 1u);   // vertex 3: on a facet, not of the input
  EXPECT_EQ(counts.interior_vertices, 1u);  // vertex 4
  EXPECT_EQ(counts.tetrahedra, 2u);
}

TEST(RestoreCoordinates, GivesBackWhatWasRounded) {
  InputPlc plc = shapes::cube();
  for (Point3& p : plc.vertices) p = (0.1 + 0.2) * p + Point3{0.1, 0.7, 1.0 / 3};
  TetMesh mesh = shapes::cube_mesh();
  mesh.vertices = plc.vertices;
  for (Point3& p : mesh.vertices) p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  mesh.vertices[7] = plc.vertices[7];
  EXPECT_EQ(baselines::restore_coordinates(plc.vertices, mesh), 7u);
  for (std::size_t v = 0; v < 8; ++v) EXPECT_EQ(as_array(mesh.vertices[v]), as_array(plc.vertices[v]));
  mesh.vertices[0].x += 1e-6;
  EXPECT_EQ(baselines::restore_coordinates(plc.vertices, mesh), 0u) << "that is no rounding";
}

TEST(RestoreCoordinates, KnowsElevenDigits) {
  std::vector<Point3> input = shapes::cube().vertices;
  TetMesh mesh = shapes::cube_mesh();
  input[7] = {1.0000000000049, 1, 1};  // "%.10E" writes 1.0000000000E+00
  EXPECT_EQ(baselines::restore_coordinates(input, mesh), 1u);
  EXPECT_EQ(as_array(mesh.vertices[7]), as_array(input[7]));
}

TEST(RestoreCoordinates, SpoilsNoTetrahedron) {
  const double tiny = 0x1p-40;
  const std::vector<Point3> input = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1 + tiny}};
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 1}, {0.25, 0.25, 1 + tiny / 2}};
  mesh.tetrahedra = {{0, 1, 2, 4}, {0, 1, 4, 3}};
  mesh.regions = {0, 0};
  EXPECT_EQ(baselines::restore_coordinates(input, mesh), 1u);
  mesh.vertices[3].z = 1;
  mesh.tetrahedra[1] = {0, 4, 1, 3};  // inverted if vertex 3 moves
  EXPECT_EQ(baselines::restore_coordinates(input, mesh), 0u);
  EXPECT_EQ(mesh.vertices[3].z, 1);
}

}  // namespace
}  // namespace ccdt
