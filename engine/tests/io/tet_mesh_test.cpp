#include "engine/base/parallel.h"
#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

const std::vector<std::string> mesh_names = {"a.mesh", "a.meshb", "a.vtu",  "a.msh", "a.msh4",
                                             "a.node", "a.ele",   "a.face", "A.VTU"};

TEST(TetMeshFiles, EveryFormatKeepsEverything) {
  for (const std::string& name : mesh_names) {
    SCOPED_TRACE(name);
    const Folder folder;
    mesh::TetMesh mesh = small_mesh();
    for (const bool claim : {true, false}) {
      mesh.constrained_delaunay = claim;
      io::write_tet_mesh(mesh, folder / name);
      expect_same_mesh(io::read_tet_mesh(folder / name), mesh);
    }
    const bool is_vtu = io::lower_ending(name) == ".vtu";
    EXPECT_EQ(folder.files(), is_vtu ? 2u : std::filesystem::exists(folder / "a.ele") ? 4u : 1u);
  }
}

TEST(TetMeshFiles, MeshesWithoutFacesAndEdges) {
  mesh::TetMesh mesh = small_mesh();
  mesh.faces.clear(), mesh.face_markers.clear(), mesh.edges.clear(), mesh.edge_markers.clear();
  for (const std::string& name : mesh_names) {
    const Folder folder;
    io::write_tet_mesh(small_mesh(), folder / name);  // whose faces and edges must not survive
    io::write_tet_mesh(mesh, folder / name);
    expect_same_mesh(io::read_tet_mesh(folder / name), mesh);
  }
}

TEST(TetMeshFiles, KeepThatThereAreNoMarkers) {
  mesh::TetMesh mesh = small_mesh();
  mesh.face_markers.clear(), mesh.edge_markers.clear();
  for (const std::string& name : mesh_names)
    for (const bool claim : {true, false}) {
      SCOPED_TRACE(name);
      const Folder folder;
      mesh.constrained_delaunay = claim;
      io::write_tet_mesh(mesh, folder / name);
      expect_same_mesh(io::read_tet_mesh(folder / name), mesh);
    }
}

/// More vertices and elements than the threads write at a time.
mesh::TetMesh long_mesh() {
  mesh::TetMesh mesh;
  for (int i = 0; i < 40000; ++i) mesh.vertices.push_back({0.1 * i, 1.0 / (i + 1), -1e-3 * i * i});
  for (std::uint32_t i = 0; i + 3 < mesh.vertices.size(); ++i) {
    mesh.tetrahedra.push_back({i, i + 1, i + 2, i + 3});
    mesh.regions.push_back(static_cast<int>(i % 7));
    if (i % 3 == 0) mesh.faces.push_back({i, i + 1, i + 2}), mesh.face_markers.push_back(static_cast<int>(i % 5) - 2);
    if (i % 2 == 0) mesh.edges.push_back({i, i + 1}), mesh.edge_markers.push_back(static_cast<int>(i % 11));
  }
  return mesh;
}

TEST(TetMeshFiles, AreTheSameOnAnyNumberOfThreads) {
  const mesh::TetMesh mesh = long_mesh();
  for (const std::string& name : mesh_names) {
    SCOPED_TRACE(name);
    const Folder one, several;
    with_threads(1, [&] { io::write_tet_mesh(mesh, one / name); });
    with_threads(3, [&] { io::write_tet_mesh(mesh, several / name); });
    for (const auto& file : std::filesystem::directory_iterator(one / "."))
      EXPECT_TRUE(bytes_of(file.path()) == bytes_of(several / file.path().filename().string())) << file.path();
    expect_same_mesh(io::read_tet_mesh(several / name), mesh);
  }
}

TEST(VtuFiles, KeepNamesOfMarkers) {
  const Folder folder;
  mesh::TetMesh mesh = small_mesh();
  const std::map<int, std::string> names = {
      {5, "inlet"}, {6, "a <b> & \"c\" 'd'"}, {-7, "\xC3\xA9t\xC3\xA9"}, {8, "</FieldData><AppendedData"}};
  mesh.face_names = names;
  io::write_tet_mesh(mesh, folder / "a.vtu");
  EXPECT_EQ(io::read_tet_mesh(folder / "a.vtu").face_names, names);
  EXPECT_EQ(io::read_tet_mesh(folder / "a.boundary.vtu").face_names, names);
  mesh.face_names = {{5, "bell \x07"}, {6, "\xE9t\xE9"}};  // no XML may have these
  io::write_tet_mesh(mesh, folder / "a.vtu");
  EXPECT_EQ(io::read_tet_mesh(folder / "a.vtu").face_names, (std::map<int, std::string>{{5, "bell _"}, {6, "_t_"}}));
}

TEST(VtuFiles, AnotherMeshsBoundaryIsRefused) {
  const Folder folder;
  mesh::TetMesh other = small_mesh();
  io::write_tet_mesh(small_mesh(), folder / "a.vtu");
  other.vertices[other.faces[0][0]].x += 1;
  io::write_tet_mesh(other, folder / "b.vtu");
  std::filesystem::rename(folder / "b.boundary.vtu", folder / "a.boundary.vtu");
  expect_input_error([&] { io::read_tet_mesh(folder / "a.vtu"); }, {});
  other.vertices.resize(1);
  other.tetrahedra.clear(), other.regions.clear(), other.faces.clear(), other.face_markers.clear();
  other.edges.clear(), other.edge_markers.clear();
  io::write_tet_mesh(small_mesh(), folder / "a.vtu");
  std::filesystem::rename(folder / "a.boundary.vtu", folder / "c.boundary.vtu");
  io::write_tet_mesh(other, folder / "a.vtu");
  std::filesystem::rename(folder / "c.boundary.vtu", folder / "a.boundary.vtu");
  expect_input_error([&] { io::read_tet_mesh(folder / "a.vtu"); }, {});
}

TEST(VtuFiles, AnotherProgramsBoundaryIsNotRead) {
  const Folder folder;
  io::write_tet_mesh(small_mesh(), folder / "a.vtu");
  std::filesystem::copy_file(folder / "a.vtu", folder / "a.boundary.vtu",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(io::read_tet_mesh(folder / "a.vtu").faces.empty());
}

TEST(TetMeshFiles, EndingsAreKnownBeforehand) {
  for (const std::string& name : mesh_names) EXPECT_TRUE(io::is_tet_mesh_file(name));
  for (const char* name : {"a.stl", "a", "a.vtk", "mesh"}) EXPECT_FALSE(io::is_tet_mesh_file(name));
  const Folder folder;
  EXPECT_THROW(io::write_tet_mesh(small_mesh(), folder / "a.vtk"), OutputError);
  expect_input_error([&] { io::read_tet_mesh(put(folder / "a.vtk", "x")); }, {"'.vtk'"});
}

TEST(TetMeshFiles, NothingIsLeftAfterFailure) {
  const Folder folder;
  std::filesystem::create_directory(folder / "a.face");  // the other three files must not appear either
  EXPECT_THROW(io::write_tet_mesh(small_mesh(), folder / "a.node"), OutputError);
  EXPECT_THROW(io::write_tet_mesh(small_mesh(), folder / "missing/a.vtu"), OutputError);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(TetMeshFiles, RefuseWhatIsNoFile) {
  const Folder folder;
  std::filesystem::create_directory(folder / "d.vtu");
  for (const std::string& name : mesh_names) {
    expect_input_error([&] { io::read_tet_mesh(folder / name); }, {});
    put(folder / "a.node", "0 3 0 0\n");  // of TetGen's files the nodes are read first
    put(folder / "a.ele", "0 4 0\n");
    put(folder / name, "");
    expect_input_error([&] { io::read_tet_mesh(folder / name); }, {});
    for (const std::string& file : {name, std::string("a.node"), std::string("a.ele")})
      std::filesystem::remove(folder / file);
  }
  expect_input_error([&] { io::read_tet_mesh(folder / "d.vtu"); }, {});
}

const std::string gmsh4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 -6 \"a $b\"\n$EndPhysicalNames\n$Entities\n1 0 1 2\n"
    "1 0 0 0 0\n5 0 0 0 1 1 1 1 9 0\n1 0 0 0 1 1 1 2 -6 8 1 5\n2 0 0 0 1 1 1 0 1 5\n$EndEntities\n$Nodes\n2 5 1 50\n"
    "2 5 1 2\n10\n50\n0 0 0 0.5 nan\n1 0 0 0.5 0.5\n3 1 0 3\n7\n8\n9\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n$Elements\n4 4 1 "
    "4\n"
    "0 1 15 1\n1 10\n2 5 2 1\n2 10 50 7\n3 1 4 1\n3 10 50 7 8\n3 2 4 1\n4 50 7 8 9\n$EndElements\n";

TEST(ReadGmsh, Version41WithEntitiesAndScatteredNodeNumbers) {
  const mesh::TetMesh mesh = mesh_of("a.msh", gmsh4);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.regions, (std::vector<int>{-6, 0}));
  EXPECT_EQ(mesh.face_markers, std::vector<int>{9});
  EXPECT_FALSE(mesh.constrained_delaunay);
}

std::string gmsh2(const std::string& elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n9 0 0 1\n$EndNodes\n$Elements\n" +
         elements + "$EndElements\n";
}

TEST(ReadGmsh, Version22WithAnyNumberOfTags) {
  const mesh::TetMesh mesh = mesh_of("a.msh", gmsh2("3\n1 15 2 0 1 9\n2 4 4 -5 1 1 1 1 2 3 9\n3 2 0 3 2 1\n"));
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.regions, std::vector<int>{-5});
  EXPECT_EQ(mesh.face_markers, std::vector<int>{0});
}

TEST(ReadGmsh, ErrorsHaveTheirPlace) {
  expect_mesh_refused("a.msh", gmsh2("1\n1 4 2 0 1 1 2 3 4\n"), {"4", 13});
  expect_mesh_refused("a.msh", gmsh2("1\n1 5 2 0 1 1 2 3 9 1 2 3 9\n"), {"5", 13});
  expect_mesh_refused("a.msh", gmsh2("1\n1 4 2 0 1 1 2 3 9\n2 4 2 0 1 1 2 3 9\n"), {"'$EndElements'", 14});
  expect_mesh_refused("a.msh", gmsh2("1000000\n"), {"1000000", 12});
  expect_mesh_refused("a.msh", "$MeshFormat\n4.1 1 8\n", {{}, {}});
  expect_mesh_refused("a.msh", "$MeshFormat\n4 0 8\n", {"'4'", 2});
  expect_mesh_refused("a.msh", "$Nodes\n1\n1 0 0 0\n", {"$MeshFormat", 1});
  expect_mesh_refused("a.msh", gmsh4.substr(0, gmsh4.size() - 30), {});
  expect_mesh_refused("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n1 0 0 1\n$EndNodes\n",
                      {"1", 7});
  expect_mesh_refused("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 inf\n$EndNodes\n", {"'inf'", 6});
}

std::string vtu(const std::string& points, const std::string& connectivity, const std::string& offsets = "4 5 8",
                const std::string& types = "10 1 5") {
  return "<?xml version='1.0'?>\n<!-- <Piece> -->\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n"
         "<UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"3\">\n<PointData><DataArray type=\"Float32\" "
         "Name=\"u\" format=\"ascii\">nan</DataArray></PointData>\n<Points>" +
         points + "</Points><Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + connectivity +
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\">" + offsets +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format='ascii'>" + types +
         "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

const std::string text_points =
    "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0\n0 1 0 0 0 0.1"
    "<InformationKey name=\"L2\"><Value index=\"0\">0</Value></InformationKey></DataArray>";
// A length of 48 bytes in 32 bits, then four points in single precision.
const std::string base64_points =
    "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"binary\">\n"
    "MAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPw==\n</DataArray>";

TEST(ReadVtu, TextAndBase64) {
  const mesh::TetMesh text = mesh_of("a.vtu", vtu(text_points, "0 1 2 3 0 0 2 1"));
  EXPECT_EQ(text.vertices[3], (Point3{0, 0, 0.1}));
  EXPECT_EQ(text.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
  EXPECT_EQ(text.faces, (std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}}));
  EXPECT_EQ(text.regions, std::vector<int>{0});
  const mesh::TetMesh base64 = mesh_of("a.vtu", vtu(base64_points, "0 1 2 3 0 0 2 1"));
  EXPECT_EQ(base64.vertices, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
}

TEST(ReadVtu, ErrorsSayWhatIsWrong) {
  const std::string good = vtu(text_points, "0 1 2 3 0 0 2 1");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  expect_mesh_refused("a.vtu", vtu(text_points, "0 1 2 4 0 0 2 1"), {"4"});
  expect_mesh_refused("a.vtu", vtu(text_points, "0 1 2 3 0 0 2"), {"2"});
  expect_mesh_refused("a.vtu", vtu(text_points, "0 1 2 3 0 0 2 1", "4 5 8", "12 1 5"), {"12"});
  expect_mesh_refused("a.vtu", vtu(text_points, "0 1 2 3 0 0 2 1", "4 5"), {"'offsets'"});
  expect_mesh_refused("a.vtu", changed("NumberOfPoints=\"4\"", "NumberOfPoints=\"4000000000\""), {"12000000000"});
  expect_mesh_refused("a.vtu", changed("0 0 0.1", "0 0 nan"), {"'nan'", 7});
  expect_mesh_refused("a.vtu", changed("UnstructuredGrid\" v", "PolyData\" v"), {});
  expect_mesh_refused("a.vtu", good.substr(0, good.size() / 2), {});
  std::string bad = vtu(base64_points, "0 1 2 3 0 0 2 1");
  std::string other = bad;
  other.replace(other.find("byte_order="), 11, "compressor='z' byte_order=");
  expect_mesh_refused("a.vtu", other, {"'z'"});
  expect_mesh_refused("a.vtu", bad.replace(bad.find("MAAA"), 4, "/AAA"), {"252"});
  expect_mesh_refused("a.vtu", bad.replace(bad.find("/AAA"), 4, "M-AA"), {});
  const Folder folder;
  io::write_tet_mesh(small_mesh(), folder / "a.vtu");
  const std::string raw = bytes_of(folder / "a.vtu");
  expect_mesh_refused("b.vtu", raw.substr(0, raw.size() - 60), {});
}

}  // namespace
}  // namespace ccdt
