#include <algorithm>
#include <set>
#include <sstream>

#include "engine/io/output_folder.h"
#include "engine/io/plain_names.h"
#include "engine/mesh/element_nodes.h"
#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;
using Corners = std::set<std::uint32_t>;

/// Two tetrahedra with a common face, three other listed faces, a segment, and a vertex that belongs to nothing.
mesh::TetMesh two_cells() {
  mesh::TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 3, 4}, {1, 3, 4, 5}};
  mesh.regions = {2, -1};
  mesh.faces = {{1, 4, 3}, {0, 3, 1}, {1, 3, 5}, {0, 1, 4}};
  mesh.face_markers = {8, 5, 5, 6};
  mesh.face_names = {{6, "inlet"}, {8, "In Let"}};
  mesh.edges = {{0, 1}};
  mesh.edge_markers = {4};
  return mesh;
}

std::string text_of_mesh(const mesh::TetMesh& mesh, const std::string& name) {
  const Folder folder;
  io::write_tet_mesh(mesh, folder / name);
  return bytes_of(folder / name);
}

/// The lines of a block of an Abaqus file, which begins with this line.
std::vector<std::vector<std::string>> block_of(const std::string& text, const std::string& head) {
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line) && line != head) {
  }
  EXPECT_EQ(line, head) << text;
  std::vector<std::vector<std::string>> block;
  while (std::getline(lines, line) && !line.starts_with("*")) {
    line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
    std::istringstream cells(line);
    block.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) block.back().push_back(cell);
  }
  return block;
}

TEST(PlainNames, AreNewAndHaveFewCharacters) {
  io::PlainNames names;
  const std::map<int, std::string> given = {{1, "side wall"}, {2, "Side_Wall"},         {3, "12 holes"},
                                            {4, ""},          {5, "\xc3\xa9t\xc3\xa9"}, {6, std::string(500, 'x')}};
  EXPECT_EQ(names.name_of(1, "MARKER_", given), "side_wall");
  EXPECT_EQ(names.name_of(2, "MARKER_", given), "Side_Wall_1");
  EXPECT_EQ(names.name_of(3, "MARKER_", given), "MARKER_12_holes");
  EXPECT_EQ(names.name_of(4, "MARKER_", given), "MARKER_");
  EXPECT_EQ(names.name_of(5, "MARKER_", given), "MARKER___t__");
  EXPECT_LE(names.name_of(6, "MARKER_", given).size(), 80u);
  EXPECT_EQ(names.name_of(-7, "MARKER_", given), "MARKER__7");
  EXPECT_EQ(names.name_of(7, "MARKER_", given), "MARKER_7");
}

TEST(AbaqusFiles, HaveSetsForRegionsMarkersAndSegments) {
  const std::string text = text_of_mesh(two_cells(), "a.inp");
  using Block = std::vector<std::vector<std::string>>;
  EXPECT_EQ(block_of(text, "*ELEMENT, TYPE=C3D4, ELSET=REGION_2"), (Block{{"1", "1", "2", "4", "5"}}));
  EXPECT_EQ(block_of(text, "*ELEMENT, TYPE=C3D4, ELSET=REGION__1"), (Block{{"2", "2", "4", "5", "6"}}));
  EXPECT_EQ(block_of(text, "*ELSET, ELSET=EALL"), (Block{{"REGION__1"}, {"REGION_2"}}));
  EXPECT_EQ(block_of(text, "*NSET, NSET=MARKER_5"), (Block{{"1", "2", "4", "6"}}));
  EXPECT_EQ(block_of(text, "*NSET, NSET=inlet"), (Block{{"1", "2", "5"}}));
  EXPECT_EQ(block_of(text, "*NSET, NSET=SEGMENT_4"), (Block{{"1", "2"}}));
}

/// The corners of a face, by the table of C3D4 in Abaqus's manual.
Corners corners_of(const mesh::TetMesh& mesh, const std::vector<std::string>& element_face) {
  const auto& t = mesh.tetrahedra.at(std::stoul(element_face.at(0)) - 1);
  if (element_face.at(1) == "S1") return {t[0], t[1], t[2]};
  if (element_face.at(1) == "S2") return {t[0], t[3], t[1]};
  if (element_face.at(1) == "S3") return {t[1], t[3], t[2]};
  EXPECT_EQ(element_face.at(1), "S4");
  return {t[2], t[3], t[0]};
}

TEST(AbaqusFiles, HaveSurfacesOfTheFacesOfElements) {
  mesh::TetMesh mesh = two_cells();
  mesh.faces.clear();
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    mesh.faces.insert(mesh.faces.end(), {{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}});
  mesh.faces.erase(mesh.faces.begin());  // the common face, as the second tetrahedron sees it, remains
  mesh.face_markers = {0, 1, 2, 3, 4, 5, 6};
  mesh.face_names.clear();
  const std::string text = text_of_mesh(mesh, "a.inp");
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const auto block = block_of(text, "*SURFACE, NAME=MARKER_" + std::to_string(i) + ", TYPE=ELEMENT");
    ASSERT_EQ(block.size(), 1u);
    EXPECT_EQ(corners_of(mesh, block[0]), Corners(mesh.faces[i].begin(), mesh.faces[i].end())) << i;
    EXPECT_EQ(block[0][0], i < 3 ? "1" : "2") << "the element that the face faces away from";
  }
  mesh.faces = {{1, 3, 4}}, mesh.face_markers = {0};  // the common face, as the first one sees it
  const auto block = block_of(text_of_mesh(mesh, "a.inp"), "*SURFACE, NAME=MARKER_0, TYPE=ELEMENT");
  EXPECT_EQ(block, (std::vector<std::vector<std::string>>{{"1", "S3"}}));
}

TEST(AbaqusFiles, GiveACoordinateTwentyCharacters) {
  mesh::TetMesh mesh = two_cells();
  mesh.vertices = {{-1.2345678901234567e-105, 1.0 / 3, -2.0 / 3}, {0.1, -1e-7 / 3, 1e300 / 7}, {}, {}, {}, {}};
  const auto nodes = block_of(text_of_mesh(mesh, "a.inp"), "*NODE, NSET=NALL");
  ASSERT_EQ(nodes.size(), 6u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string& digits = nodes[i].at(axis + 1);
      const double x = as_array(mesh.vertices[i])[axis];
      EXPECT_LE(digits.size(), 20u);
      EXPECT_LE(std::fabs(std::stod(digits) - x), 1e-12 * std::fabs(x)) << digits;
    }
  }
  EXPECT_EQ(std::stod(nodes[0][2]), 1.0 / 3) << "where there is room, bit for bit";
}

/// The items of a list in a file of OpenFOAM, each without its parentheses.
std::vector<std::string> list_in(const std::filesystem::path& file, const std::string& after = "}\n") {
  const std::string text = bytes_of(file);
  std::istringstream lines(text.substr(text.find(after) + after.size()));
  std::size_t claimed = 0;
  lines >> claimed;
  std::vector<std::string> items;
  std::string line;
  std::getline(lines, line), std::getline(lines, line);
  while (std::getline(lines, line) && line != ")") items.push_back(line);
  EXPECT_EQ(items.size(), claimed) << file;
  return items;
}

TEST(PolyMesh, HasFacesInOrderWithPatchesAndZones) {
  const Folder folder;
  const auto place = folder / "polyMesh";
  io::write_tet_mesh(two_cells(), place, "polymesh");
  EXPECT_EQ(folder.files(), 1u);
  EXPECT_EQ(list_in(place / "points"),
            (std::vector<std::string>{"(0 0 0)", "(1 0 0)", "(0 1 0)", "(0 0 1)", "(1 1 1)"}));
  const std::vector<std::string> faces = list_in(place / "faces");
  EXPECT_EQ(faces.front(), "3(1 2 3)") << "inside, facing away from the first cell";
  EXPECT_EQ(faces.size(), 7u);
  EXPECT_EQ(list_in(place / "owner"), (std::vector<std::string>{"0", "0", "1", "1", "0", "1", "0"}));
  EXPECT_EQ(list_in(place / "neighbour"), std::vector<std::string>{"1"});
  const std::string boundary = bytes_of(place / "boundary");
  for (const char* patch : {"MARKER_0\n{\n    type patch;\n    nFaces 3;\n    startFace 1;",
                            "MARKER_5\n{\n    type patch;\n    nFaces 2;\n    startFace 4;",
                            "inlet\n{\n    type patch;\n    nFaces 1;\n    startFace 6;"})
    EXPECT_NE(boundary.find(patch), std::string::npos) << boundary;
  EXPECT_EQ(list_in(place / "cellZones", "REGION_2\n{\n    type cellZone;\n    cellLabels List<label> "),
            std::vector<std::string>{"0"});
  EXPECT_EQ(list_in(place / "faceZones", "In_Let\n{\n    type faceZone;\n    faceLabels List<label> "),
            std::vector<std::string>{"0"});
  EXPECT_EQ(list_in(place / "faceZones", "flipMap List<bool> "), std::vector<std::string>{"1"});
}

TEST(PolyMesh, ReplacesAnotherOneAndNothingElse) {
  const Folder folder;
  const auto place = folder / "polyMesh";
  mesh::TetMesh mesh = two_cells();
  std::filesystem::create_directory(place);
  io::write_tet_mesh(mesh, place, "polymesh");
  EXPECT_TRUE(std::filesystem::exists(place / "cellZones"));
  mesh.regions = {1, 1};
  io::write_tet_mesh(mesh, place.string() + "/", "polymesh");
  EXPECT_FALSE(std::filesystem::exists(place / "cellZones")) << "it was that of the old mesh";
  EXPECT_EQ(folder.files(), 1u);

  std::filesystem::remove(place / "owner");
  for (const auto& other : {place, put(folder / "file", "x")}) {
    EXPECT_THROW(io::check_tet_mesh_output(other, "polymesh"), OutputError);
    EXPECT_THROW(io::write_tet_mesh(mesh, other, "polymesh"), OutputError);
  }
  EXPECT_THROW(io::write_tet_mesh(mesh, folder / "missing/polyMesh", "polymesh"), OutputError);
  EXPECT_THROW(io::check_tet_mesh_output(place, "vtu"), OutputError);
  EXPECT_EQ(folder.files(), 2u);
}

TEST(OutputFolder, IsRemovedWithItsFilesBySignals) {
  const Folder folder;
  io::OutputFolder out(folder / "a");
  put(out.file("b"), "x");
  put(out.file("c"), "x");
  EXPECT_EQ(folder.files(), 1u);
  io::remove_unfinished_files();
  EXPECT_EQ(folder.files(), 0u);
}

TEST(XdmfFiles, AppearTogether) {
  const Folder folder;
  std::filesystem::create_directory(folder / "a.boundary.xdmf");
  EXPECT_THROW(io::write_tet_mesh(two_cells(), folder / "a.xdmf"), OutputError);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(SecondOrder, NodesInTheMiddleOfEdgesAreShared) {
  mesh::TetMesh mesh = two_cells();
  const mesh::ElementNodes nodes(mesh, 2);
  EXPECT_EQ(nodes.count(), mesh.vertices.size() + 9) << "two tetrahedra with a common face have nine edges";
  const auto middle = [&](std::uint32_t a, std::uint32_t b) { return 0.5 * (mesh.vertices[a] + mesh.vertices[b]); };
  for (const auto& t : mesh.tetrahedra) {
    const std::array<Point3, 10> wanted = {
        mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]], middle(t[0], t[1]),
        middle(t[1], t[2]),  middle(t[0], t[2]),  middle(t[0], t[3]),  middle(t[1], t[3]),  middle(t[2], t[3])};
    for (std::size_t k = 0; k < nodes.per_element(4); ++k) EXPECT_EQ(nodes.point(nodes.node(t, k)), wanted[k]) << k;
  }
  EXPECT_EQ(nodes.per_element(3), 6u);
  EXPECT_EQ(nodes.node(mesh.faces[0], 4), nodes.node(mesh.tetrahedra[0], 9)) << "vertices 3 and 4";
  EXPECT_EQ(nodes.node(mesh.edges[0], 2), nodes.node(mesh.tetrahedra[0], 4)) << "vertices 0 and 1";
}

TEST(SecondOrder, GmshPutsTheLastTwoEdgesOfATetrahedronInAnotherOrder) {
  mesh::TetMesh mesh = two_cells();
  mesh.tetrahedra.resize(1), mesh.regions.resize(1);
  const mesh::ElementNodes nodes(mesh, 2);
  const Folder folder;
  io::write_tet_mesh(mesh, folder / "a.msh", "msh", 2);
  std::string element = "6 11 2 2 1";  // after an edge and four faces
  for (const std::size_t k : {0, 1, 2, 3, 4, 5, 6, 7, 9, 8})
    element += " " + std::to_string(nodes.node(mesh.tetrahedra[0], k) + 1);
  EXPECT_NE(bytes_of(folder / "a.msh").find("\n" + element + "\n"), std::string::npos) << element;
}

TEST(SecondOrder, IsRefusedWhereTheFormatDoesNotHoldIt) {
  const Folder folder;
  for (const char* name : {"a.mesh", "a.meshb", "a.node", "a.polymesh"}) {
    EXPECT_THROW(io::check_tet_mesh_output(folder / name, "", 2), OutputError);
    EXPECT_THROW(io::write_tet_mesh(two_cells(), folder / name, "", 2), OutputError);
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(SimulationFiles, AreNotRead) {
  const Folder folder;
  for (const char* name : {"a.inp", "a.xdmf"}) {
    io::write_tet_mesh(two_cells(), folder / name);
    EXPECT_THROW(io::read_tet_mesh(folder / name), InputError);
  }
}

}  // namespace
}  // namespace ccdt
