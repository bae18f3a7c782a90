#include <algorithm>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

// foreign/make_files.py says how these files were made.
const std::filesystem::path foreign = std::filesystem::path(CCDT_SOURCE_DIR) / "engine/tests/io/foreign";

mesh::TetMesh mesh_of_two_tetrahedra() {
  mesh::TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1.0 / 3, 1.1, 1.2}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.regions = {7, -8};
  mesh.faces = {{0, 2, 1}, {1, 2, 4}};
  mesh.face_markers = {5, 6};
  mesh.edges = {{0, 1}};
  mesh.edge_markers = {3};
  return mesh;
}

TEST(ForeignFiles, OfVtkInAllEncodings) {
  for (const char* kind :
       {"inline", "inline-zlib", "inline-zlib-big-64", "raw-zlib", "raw-big-64", "base64-zlib-64", "base64-big"}) {
    SCOPED_TRACE(kind);
    expect_same_mesh(io::read_tet_mesh(foreign / ("vtk-" + std::string(kind) + ".vtu")), mesh_of_two_tetrahedra());
  }
  mesh::TetMesh text = io::read_tet_mesh(foreign / "vtk-ascii.vtu");
  EXPECT_NEAR(text.vertices[4].x, 1.0 / 3, 1e-9) << "VTK writes fewer digits in text";
  text.vertices = mesh_of_two_tetrahedra().vertices;
  expect_same_mesh(text, mesh_of_two_tetrahedra());
}

TEST(ForeignFiles, OfMeshioInMeditBinary) {
  expect_same_mesh(io::read_tet_mesh(foreign / "meshio.meshb"), mesh_of_two_tetrahedra());
  const plc::InputPlc plc = io::read_plc(foreign / "meshio.meshb");
  EXPECT_EQ(plc.triangles.size(), 7u);
  EXPECT_TRUE(std::ranges::equal(std::span(plc.triangles).first(2), mesh_of_two_tetrahedra().faces));
  EXPECT_EQ(plc.triangle_markers, std::vector({5, 6, 0, 0, 0, 0, 0}));
  EXPECT_EQ(plc.segments, mesh_of_two_tetrahedra().edges);
}

TEST(ForeignFiles, OfGmshInTextAndBinary) {
  const mesh::TetMesh first = io::read_tet_mesh(foreign / "gmsh-msh41-binary.msh");
  EXPECT_GT(first.tetrahedra.size(), 0u);
  EXPECT_EQ(first.regions, std::vector<int>(first.tetrahedra.size(), 7));
  EXPECT_EQ(first.edge_markers, std::vector<int>(first.edges.size(), 3));
  EXPECT_EQ(first.face_markers.front(), 5);
  EXPECT_EQ(first.face_markers.back(), 6);
  for (const char* name : {"gmsh-msh41-text.msh", "gmsh-msh22-binary.msh", "gmsh-msh22-text.msh"}) {
    SCOPED_TRACE(name);
    const mesh::TetMesh mesh = io::read_tet_mesh(foreign / name);
    EXPECT_EQ(mesh.tetrahedra, first.tetrahedra);
    EXPECT_EQ(mesh.regions, first.regions);
    EXPECT_EQ(mesh.faces, first.faces);
    EXPECT_EQ(mesh.face_markers, first.face_markers);
    EXPECT_EQ(mesh.edges, first.edges);
    EXPECT_EQ(mesh.edge_markers, first.edge_markers);
    ASSERT_EQ(mesh.vertices.size(), first.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      EXPECT_LT(length(mesh.vertices[i] - first.vertices[i]), 1e-12) << "Gmsh rounds in text";
  }
}

double volume_of(const plc::InputPlc& plc) {
  double sixfold = 0;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    sixfold += dot(plc.vertices[a], cross(plc.vertices[b], plc.vertices[c]));
  };
  for (const auto& [a, b, c] : plc.triangles) add(a, b, c);
  for (const plc::PolygonFacet& facet : plc.polygon_facets)
    for (std::size_t k = 2; k < facet.polygons[0].size(); ++k)
      add(facet.polygons[0][0], facet.polygons[0][k - 1], facet.polygons[0][k]);
  return sixfold / 6;
}

TEST(ForeignSurfaces, OfGmshKeepTheNamesOfPhysicalGroups) {
  for (const char* name : {"msh41-text", "msh41-binary", "msh22-text", "msh22-binary"}) {
    SCOPED_TRACE(name);
    const plc::InputPlc plc = io::read_plc(foreign / ("named-gmsh-" + std::string(name) + ".msh"));
    EXPECT_EQ(plc.inside, plc::InputPlc::Inside::even_odd);
    EXPECT_EQ(plc.triangles.size(), 10u);
    EXPECT_EQ(plc.vertices.size(), 7u);
    EXPECT_NEAR(std::fabs(volume_of(plc)), 1.0 / 6, 1e-9);
    EXPECT_EQ(plc.marker_names, (std::map<int, std::string>{{2, "side wall"}, {5, "inlet"}}));
    EXPECT_EQ(std::ranges::count(plc.triangle_markers, 5), 2);
    EXPECT_EQ(std::ranges::count(plc.triangle_markers, 2), 8);
    EXPECT_TRUE(plc.notes.empty());
  }
}

TEST(ForeignSurfaces, OfVtkAndMeshioHaveMarkers) {
  const plc::InputPlc polygons = io::read_plc(foreign / "surface.vtp"),
                      triangles = io::read_plc(foreign / "surface.vtu");
  ASSERT_EQ(polygons.polygon_facets.size(), 1u);
  EXPECT_EQ(polygons.polygon_facets[0].marker, 9);
  EXPECT_EQ(polygons.triangle_markers, std::vector<int>(4, 4));
  EXPECT_EQ(triangles.triangle_markers, (std::vector<int>{4, 4, 4, 4, 9, 9}));
  for (const plc::InputPlc& plc : {polygons, triangles}) {
    EXPECT_EQ(plc.inside, plc::InputPlc::Inside::even_odd);
    EXPECT_EQ(plc.vertices.size(), 5u);
    EXPECT_NEAR(volume_of(plc), 1.0 / 9, 1e-12);
  }
}

TEST(ForeignSurfaces, OfGzip) {
  const plc::InputPlc plc = io::read_plc(foreign / "surface.stl.gz");
  EXPECT_EQ(plc.triangles.size(), 6u);
  EXPECT_NEAR(volume_of(plc), 1.0 / 9, 1e-6);
}

TEST(ForeignSurfaces, OfTetrahedraAreTheBoundariesOfRegions) {
  const plc::InputPlc vtk = io::read_plc(foreign / "vtk-raw-zlib.vtu");
  EXPECT_EQ(vtk.notes.size(), 1u);
  EXPECT_EQ(vtk.triangles.size(), 7u) << "six and the one between the two regions";
  EXPECT_EQ(std::ranges::count(vtk.triangle_markers, 5), 1) << "the listed ones have their markers";
  EXPECT_EQ(std::ranges::count(vtk.triangle_markers, 6), 1);
  EXPECT_EQ(vtk.segments, mesh_of_two_tetrahedra().edges);
  const plc::InputPlc gmsh = io::read_plc(foreign / "gmsh-msh41-binary.msh");
  EXPECT_EQ(gmsh.notes.size(), 1u);
  EXPECT_EQ(gmsh.triangles.size(), 10u);
  EXPECT_EQ(std::ranges::count(gmsh.triangle_markers, 0), 0) << "all are listed, with their markers";
}

TEST(ForeignSurfaces, OfTetrahedraKeepListedFacesInsideAndNoInteriorVertices) {
  mesh::TetMesh mesh = mesh_of_two_tetrahedra();
  mesh.faces = {{1, 2, 3}}, mesh.face_markers = {6}, mesh.face_names = {{6, "wall"}, {7, "nowhere"}};
  mesh.vertices.push_back({0.1, 0.1, 0.1});
  const Folder folder;
  io::write_tet_mesh(mesh, folder / "a.msh");
  const plc::InputPlc plc = io::read_plc(folder / "a.msh");
  EXPECT_EQ(plc.vertices.size(), 5u);
  EXPECT_EQ(plc.triangles.size(), 7u);
  EXPECT_EQ(std::ranges::count(plc.triangle_markers, 6), 1);
  EXPECT_EQ(plc.marker_names, (std::map<int, std::string>{{6, "wall"}}));
}

}  // namespace
}  // namespace ccdt
