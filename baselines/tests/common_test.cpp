#include "baselines/common.h"

#include <gtest/gtest.h>

#include "baselines/tests/shapes.h"

namespace ccdt {
namespace {

TEST(MergeEqualVertices, MakesARepeatedVertexOne) {
  const InputPlc merged = merge_equal_vertices(shapes::with_repeated_vertices(shapes::cube()));
  EXPECT_EQ(merged.vertices.size(), 8u);
  EXPECT_EQ(merged.triangles.size(), 12u);
}

TEST(MergeEqualVertices, KeepsTheOrderAndTakesMinusZeroForZero) {
  InputPlc plc;
  plc.vertices = {{1, 0, 0}, {0, 0, 0}, {1, -0.0, 0}, {2, 0, 0}};
  plc.triangles = {{2, 1, 3}};
  plc.segments = {{0, 3}};
  const InputPlc merged = merge_equal_vertices(plc);
  ASSERT_EQ(merged.vertices.size(), 3u);
  EXPECT_EQ(merged.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(merged.segments[0], (std::array<std::uint32_t, 2>{0, 2}));
}

TEST(MedianEdgeLength, OfACubeIsItsSideAndWithoutFacetsZero) {
  EXPECT_EQ(median_edge_length(shapes::cube()), 1);
  EXPECT_EQ(median_edge_length({}), 0);
}

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
  keep_odd_regions(mesh);
  EXPECT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 5u);
}

TEST(OrientPositively, TurnsAMeshThatIsInsideOut) {
  TetMesh mesh = two_tetrahedra();
  mesh.tetrahedra = {{1, 0, 2, 3}};
  orient_positively(mesh);
  EXPECT_EQ(mesh.tetrahedra[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
}

TEST(CountElements, TellsInputSteinerAndInteriorVerticesApart) {
  InputPlc plc;
  plc.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  TetMesh mesh = two_tetrahedra();
  mesh.faces = {{0, 1, 3}};
  const MeshCounts counts = count_elements(plc, mesh);
  EXPECT_EQ(counts.vertices, 5u);
  EXPECT_EQ(counts.steiner_vertices, 1u);   // vertex 3: on a facet, not of the input
  EXPECT_EQ(counts.interior_vertices, 1u);  // vertex 4
  EXPECT_EQ(counts.tetrahedra, 2u);
}

TEST(Digits, ReadBackBitForBit) {
  EXPECT_EQ(std::stod(digits(0.1)), 0.1);
}

}  // namespace
}  // namespace ccdt
