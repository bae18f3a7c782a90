#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

const std::string cube_corner_nodes = "# nodes\n4 3 1 1\n0 0 0 0 7 1\n1 1 0 0 7 1 # c\n\n2 0 1 0 7 1\n3 0 0 1 7 1\n";

TEST(ReadPoly, FacetsWithHolesSegmentsAndVertices) {
  const plc::InputPlc plc = plc_of(
      "a.poly", cube_corner_nodes +
                    "4 1\n1 0 5\n3 0 1 2\n1\n2 0\n3\n3 1 5\n3 0 1\n 2\n2 0 3\n1 3\n1 0.1 0.2 0.3\n1 0 2\n4 0 1 2 3\n"
                    "1\n1 0.5 0.5 0.5\n2\n1 1 2 3 4.0 -1\n2 1 2 3 -7\n");
  EXPECT_EQ(plc.inside, plc::InputPlc::Inside::seeds);
  EXPECT_EQ(plc.vertices.size(), 4u);
  EXPECT_EQ(plc.triangles.size(), 1u);
  EXPECT_EQ(plc.triangle_markers, std::vector<int>{5});
  EXPECT_EQ(plc.segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 3}}));
  ASSERT_EQ(plc.polygon_facets.size(), 2u);
  EXPECT_EQ(plc.polygon_facets[0].polygons, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 3}, {3}}));
  EXPECT_EQ(plc.polygon_facets[0].holes, (std::vector<Point3>{{0.1, 0.2, 0.3}}));
  EXPECT_EQ(plc.polygon_facets[0].marker, 5);
  EXPECT_EQ(plc.polygon_facets[0].number, 2u);
  EXPECT_EQ(plc.holes, (std::vector<Point3>{{0.5, 0.5, 0.5}}));
  ASSERT_EQ(plc.regions.size(), 2u);
  EXPECT_EQ(plc.regions[0].attribute, 4);
  EXPECT_EQ(plc.regions[0].max_volume, 0);
  EXPECT_EQ(plc.regions[1].attribute, -7);
}

TEST(ReadPoly, NodesBesideAndFromOne) {
  const Folder folder;
  put(folder / "a.node", "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n");
  const plc::InputPlc plc = io::read_plc(put(folder / "a.poly", "0 3 0 0\n1 0\n1\n3 1 2 3\n0\n0\n"));
  EXPECT_EQ(plc.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(io::read_plc(folder / "a.node").vertices.size(), 3u);
  EXPECT_EQ(io::read_plc(folder / "a.node").inside, plc::InputPlc::Inside::seeds);
  std::filesystem::remove(folder / "a.node");
  expect_input_error([&] { io::read_plc(folder / "a.poly"); }, {});
}

TEST(ReadSmesh, MarkersStandBehindTheCorners) {
  const plc::InputPlc plc = plc_of("a.smesh", cube_corner_nodes + "3 1\n3 0 1 2 -4\n4 0 1\n 2 3 6\n2 0 1 8\n0\n");
  EXPECT_EQ(plc.triangle_markers, std::vector<int>{-4});
  EXPECT_EQ(plc.polygon_facets.at(0).marker, 6);
  EXPECT_EQ(plc.segment_markers, std::vector<int>{8});
}

TEST(ReadPoly, ErrorsHaveTheirPlace) {
  expect_refused("a.poly", cube_corner_nodes + "1 0\n1\n3 0 1 4\n", {"4", 10, {}, 0});
  expect_refused("a.poly", cube_corner_nodes + "2 0\n1\n3 0 1 2\n1\n3 0 1 ", {{}, 12, {}, 1});
  expect_refused("a.poly", cube_corner_nodes + "1 1\n1 0 0.5\n3 0 1 2\n", {{}, 9, {}, 0});
  expect_refused("a.poly", cube_corner_nodes + "900000 0\n", {"900000", 8});
  expect_refused("a.poly", cube_corner_nodes + "1 0\n800000\n", {"800000", 9, {}, 0});
  expect_refused("a.poly", cube_corner_nodes + "0 0\n1\n1 0 0 nan\n", {"'nan'", 10});
  expect_refused("a.node", "2000000000 3 0 0\n1 0 0 0\n", {"2000000000", 1});
  expect_refused("a.node", "2 2 0 0\n1 0 0\n2 0 1\n", {"2", 1});
  expect_refused("a.node", "2 3 0 0\n1 0 0 0\n3 0 1 0\n", {"3", 3});
  expect_refused("a.node", "2 3 0 0\n5 0 0 0\n6 0 1 0\n", {"5", 2});
  expect_refused("a.node", "2 3 0 0\n1 0 0 0\n2 0 inf 0\n", {"'inf'", 3});
}

const std::string medit_head =
    "MeshVersionFormatted 1\nDimension\n3\n# c\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n";

TEST(ReadMedit, OtherSectionsAreSkipped) {
  const std::string file =
      medit_head +
      "Corners 2 1 2\nRequiredEdges\n1\n1\nQuadrilaterals 1\n1 2 3 4 9\nTriangles 2\n1 2 3 5\n"
      "4 3 2 6\nNormals 1\n0 0 nan\nEdges 1 1 2 8\nTetrahedra 1\n1 2 3 4 -3\nSomethingNew\n1 2\nEnd\n";
  const plc::InputPlc plc = plc_of("a.mesh", file);
  EXPECT_EQ(plc.triangle_numbers, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(plc.triangle_markers, (std::vector<int>{5, 6}));
  EXPECT_EQ(plc.polygon_facets.at(0).number, 0u);
  EXPECT_EQ(plc.segment_markers, std::vector<int>{8});
  const mesh::TetMesh mesh = mesh_of("a.mesh", file);
  EXPECT_EQ(mesh.regions, std::vector<int>{-3});
  EXPECT_EQ(mesh.faces.size(), 2u);
  EXPECT_EQ(mesh.edge_markers, std::vector<int>{8});
  EXPECT_FALSE(mesh.constrained_delaunay);
}

TEST(ReadMedit, AWholeMeshMayLeaveOutEnd) {
  EXPECT_EQ(mesh_of("a.mesh", medit_head + "Tetrahedra\n1\n1 2 3 4 7\n").regions, std::vector<int>{7});
  const auto read = [](const std::string& tail) { mesh_of("a.mesh", medit_head + tail); };
  EXPECT_THROW(read("Tetrahedra\n1\n1 2 3 4 7"), InputError) << "7 may be the start of a longer number";
  EXPECT_THROW(read("Tetrahedra\n2\n1 2 3 4 7\n"), InputError);
  EXPECT_THROW(read("Triangles\n1\n1 2 3 5\n"), InputError) << "tetrahedra are to follow";
}

TEST(ReadMedit, ErrorsHaveTheirPlace) {
  expect_refused("a.mesh", medit_head + "Triangles 1\n1 2 5 0\nEnd\n", {"5", 12, {}, 0});
  expect_refused("a.mesh", medit_head + "Triangles 1\n1 2 0 0\nEnd\n", {"0", 12, {}, 0});
  expect_refused("a.mesh", medit_head + "Triangles 1\n1 2 3 0", {"'End'", 12});
  expect_refused("a.mesh", medit_head + "Triangles 700000000\n1 2 3 0\n", {"700000000", 11});
  expect_refused("a.mesh", medit_head + "Triangles 1\n1 2 3 0\n3 2 1 0\nEnd\n", {"'3'", 13});
  expect_refused("a.mesh", "MeshVersionFormatted 1\nDimension 2\n", {"2", 2});
  expect_refused("a.mesh", "solid\n", {"'MeshVersionFormatted'", 1});
}

TEST(ReadTetgenMesh, ZeroBasedWithoutMarkersAndWithNeighbors) {
  const Folder folder;
  put(folder / "a.1.node", cube_corner_nodes);
  put(folder / "a.1.ele", "1 4 0\n0 0 1 2 3\n");
  put(folder / "a.1.face", "1 1\n0 0 1 2 -1 5 6\n# Generated by tetgen\n");
  for (const char* name : {"a.1.node", "a.1.ele", "a.1.face"}) {
    const mesh::TetMesh mesh = io::read_tet_mesh(folder / name);
    EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
    EXPECT_EQ(mesh.regions, std::vector<int>{0});
    EXPECT_EQ(mesh.face_markers, std::vector<int>{-1});
    EXPECT_TRUE(mesh.edges.empty());
  }
  put(folder / "a.1.ele", "1 4 0\n0 0 1 2 4\n");
  expect_input_error([&] { io::read_tet_mesh(folder / "a.1.node"); }, {"0", 2});
  put(folder / "a.1.ele", "1 10 0\n0 0 1 2 3 0 0 0 0 0 0\n");
  expect_input_error([&] { io::read_tet_mesh(folder / "a.1.node"); }, {"4", 1});
  std::filesystem::remove(folder / "a.1.ele");
  expect_input_error([&] { io::read_tet_mesh(folder / "a.1.node"); }, {});
}

}  // namespace
}  // namespace ccdt
