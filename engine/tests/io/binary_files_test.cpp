#include <algorithm>
#include <cstring>
#include <functional>

#include "engine/io/formats.h"
#include "engine/tests/io/io_test_files.h"
#include "engine/tests/shared/little_memory.h"

namespace ccdt {
namespace {

using namespace io_test;

io::FileBytes in_memory(std::string_view bytes) {
  return {"damaged", std::string(bytes)};
}

/// The reader of a binary format, and a valid file in this format.
struct BinaryFormat {
  std::string name, good;
  std::function<void(const io::FileBytes&)> read;
  std::size_t optional_end = 0;  ///< this many bytes at the end may be missing
};

template <class Mesh>
std::string written(const Mesh& mesh, void (*write)(const Mesh&, io::OutputFile&)) {
  const Folder folder;
  io::OutputFile out(folder / "a");
  write(mesh, out);
  out.commit();
  return bytes_of(folder / "a");
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A binary file of version 2.2, which we do not write: a tetrahedron of region 9, a point, and two faces in one block.
std::string binary_gmsh2() {
  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  append(bytes, 1);
  bytes += "\n$EndMeshFormat\n$Nodes\n4\n";
  for (const int i : {1, 2, 3, 9}) {
    append(bytes, i);
    append(bytes, std::array<double, 3>{i == 2 ? 1.0 : 0.0, i == 3 ? 0.1 : 0.0, i == 9 ? 1.0 : 0.0});
  }
  bytes += "\n$EndNodes\n$Elements\n4\n";
  for (const int i :
       {4,      1, 2, /**/ 1, 9, 4, 1, 2, 3, 9, /**/ 15, 1, 0, /**/ 2, 1, /**/ 2, 2, 2, /**/ 3, -5, 1, 1, 2, 3,
        /**/ 4, 6, 1, 1,      3, 9})
    append(bytes, i);
  return bytes + "\n$EndElements\n";
}

std::vector<BinaryFormat> binary_formats() {
  const auto as_mesh = [](mesh::TetMesh (*read)(const io::FileBytes&)) {
    return [read](const io::FileBytes& file) { read(file); };
  };
  const auto as_plc = [](plc::InputPlc (*read)(const io::FileBytes&)) {
    return [read](const io::FileBytes& file) { read(file); };
  };
  plc::InputPlc triangles = awkward_surface();
  triangles.vertices.assign(5, {1, 2, 3});
  triangles.polygon_facets.clear();
  const std::size_t vtu_end = std::string(">\n</VTKFile>\n").size();
  // In .meshb, our claim follows the keyword End; a text needs no line end after the last word.
  return {
      {"meshb", written(small_mesh(), io::write_meditb_mesh), as_mesh(io::read_meditb_mesh),
       io::claims_of(small_mesh()).size()},
      {"meshb surface", written(awkward_surface(), io::write_meditb_plc), as_plc(io::read_meditb_plc),
       io::even_odd_claim.size()},
      {"vtu", written(mesh::ElementNodes(small_mesh(), 1), io::write_vtu_tetrahedra), as_mesh(io::read_vtu), vtu_end},
      {"boundary vtu", written(mesh::ElementNodes(small_mesh(), 1), io::write_vtu_boundary), as_mesh(io::read_vtu),
       vtu_end},
      {"msh4", written(mesh::ElementNodes(small_mesh(), 1), io::write_gmsh4), as_mesh(io::read_gmsh), 1},
      {"binary msh2", binary_gmsh2(), as_mesh(io::read_gmsh), 1},
      {"ply", written(awkward_surface(), io::write_ply), as_plc(io::read_ply)},
      {"stl", written(triangles, io::write_stl), as_plc(io::read_stl)}};
}

/// \return  is the file refused? Anything but one of our errors with its place and remedy is a failure.
bool is_refused(const BinaryFormat& format, std::string_view bytes) {
  try {
    format.read(in_memory(bytes));
  } catch (const InputError& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    EXPECT_EQ(error.place().file, "damaged") << error.what();
    EXPECT_TRUE(error.place().line > 0 || error.place().byte >= 0) << error.what();
    return true;
  }
  return false;
}

TEST(BinaryFiles, EveryPrefixIsRefused) {
  const LittleMemory little(std::size_t{64} << 20);
  for (const BinaryFormat& format : binary_formats()) {
    SCOPED_TRACE(format.name);
    EXPECT_FALSE(is_refused(format, format.good));
    for (std::size_t size = 1; size < format.good.size(); ++size)
      EXPECT_EQ(is_refused(format, std::string_view(format.good).substr(0, size)),
                size + format.optional_end < format.good.size())
          << size << " of " << format.good.size() << " bytes";
  }
}

TEST(BinaryFiles, EveryByteMayBeWrong) {
  const LittleMemory little(std::size_t{64} << 20);
  for (const BinaryFormat& format : binary_formats()) {
    SCOPED_TRACE(format.name);
    std::size_t refused = 0;
    for (std::size_t i = 0; i < format.good.size(); ++i) {
      const char good = format.good[i];
      for (const int wrong : {good ^ 1, good ^ 0x10, good ^ 0x80, 0, 0x7F, 0xFF}) {
        std::string bytes = format.good;
        bytes[i] = static_cast<char>(wrong);
        refused += is_refused(format, bytes) ? 1 : 0;
      }
    }
    EXPECT_GT(refused, format.name == "stl" ? 10u : format.good.size() / 2);
  }
}

TEST(ReadGmsh, Version22InBinary) {
  const mesh::TetMesh mesh = io::read_gmsh(in_memory(binary_gmsh2()));
  EXPECT_EQ(mesh.vertices, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}, {0, 0, 1}}));
  EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
  EXPECT_EQ(mesh.regions, std::vector<int>{9});
  EXPECT_EQ(mesh.faces, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.face_markers, (std::vector<int>{-5, 6}));
}

template <class Integer>
void append_swapped(std::string& bytes, Integer value) {
  append(bytes, value);
  std::reverse(bytes.end() - sizeof value, bytes.end());
}

/// A handmade .meshb file: four vertices, a section of unknown type, and a tetrahedron of region -3.
template <class Real, class Integer, class Position>
std::string meshb(int version, bool swapped) {
  std::string bytes;
  const auto put = [&](auto value) { swapped ? append_swapped(bytes, value) : append(bytes, value); };
  const auto begin = [&](std::int32_t keyword, std::size_t contents) {
    put(keyword);
    put(static_cast<Position>(bytes.size() + sizeof(Position) + contents));
  };
  put(std::int32_t{1});
  put(std::int32_t{version});
  begin(3, 4);
  put(std::int32_t{3});
  begin(4, sizeof(Integer) + 4 * (3 * sizeof(Real) + sizeof(Integer)));
  put(Integer{4});
  for (const int axis : {-1, 0, 1, 2}) {
    for (int k = 0; k < 3; ++k) put(static_cast<Real>(k == axis ? 0.5 : 0));
    put(Integer{77});
  }
  begin(13, 5);
  bytes += "stuff";
  begin(8, 6 * sizeof(Integer));
  for (const int i : {1, 1, 2, 3, 4, -3}) put(static_cast<Integer>(i));
  put(std::int32_t{54});
  put(Position{0});
  return bytes;
}

TEST(ReadMeditBinary, AllVersionsInBothByteOrders) {
  for (const bool swapped : {false, true})
    for (const std::string& bytes :
         {meshb<float, std::int32_t, std::int32_t>(1, swapped), meshb<double, std::int32_t, std::int32_t>(2, swapped),
          meshb<double, std::int32_t, std::int64_t>(3, swapped),
          meshb<double, std::int64_t, std::int64_t>(4, swapped)}) {
      const mesh::TetMesh mesh = io::read_meditb_mesh(in_memory(bytes));
      EXPECT_EQ(mesh.vertices, (std::vector<Point3>{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}));
      EXPECT_EQ(mesh.tetrahedra, (std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
      EXPECT_EQ(mesh.regions, std::vector<int>{-3});
    }
}

TEST(ReadMeditBinary, ErrorsHaveTheirPlace) {
  const std::string good = meshb<double, std::int32_t, std::int32_t>(2, false);
  const auto changed = [&](std::size_t byte, auto value) {
    std::string bytes = good;
    std::memcpy(bytes.data() + byte, &value, sizeof value);
    return bytes;
  };
  expect_mesh_refused("a.meshb", changed(0, 2), {{}, {}, 0});
  expect_mesh_refused("a.meshb", changed(4, 5), {"5", {}, 4});
  expect_mesh_refused("a.meshb", changed(16, 2), {"2", {}, 16});
  expect_mesh_refused("a.meshb", changed(24, 20), {"20", {}, 24});
  expect_mesh_refused("a.meshb", changed(28, 1000000), {"28000000", {}, 28});
  expect_mesh_refused("a.meshb", changed(28, -1), {"-1", {}, 28});
  expect_mesh_refused("a.meshb", changed(60, static_cast<double>(NAN)), {"1", {}, 60});
  expect_mesh_refused("a.meshb", changed(good.size() - 16, 5), {"5"});
  expect_mesh_refused("a.meshb", good.substr(0, good.size() - 8), {{}, {}, static_cast<long long>(good.size()) - 8});
}

TEST(WriteVtu, IsCompressed) {
  mesh::TetMesh mesh = small_mesh();
  for (int k = 0; k < 15; ++k)
    mesh.tetrahedra.insert(mesh.tetrahedra.end(), mesh.tetrahedra.begin(), mesh.tetrahedra.end());
  mesh.regions.resize(mesh.tetrahedra.size(), 3);  // a megabyte of connectivity in several blocks
  const std::string bytes = written(mesh::ElementNodes(mesh, 1), io::write_vtu_tetrahedra);
  EXPECT_LT(bytes.size(), 16 * mesh.tetrahedra.size() / 4);
  mesh.faces.clear(), mesh.face_markers.clear();
  mesh.edges.clear(), mesh.edge_markers.clear();
  expect_same_mesh(io::read_vtu(in_memory(bytes)), mesh);
}

TEST(WriteGmsh4, MarkersMayAlternate) {
  mesh::TetMesh mesh = small_mesh();
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}, {0, 1, 2, 4}, {4, 3, 2, 1}};
  mesh.regions = {2, 0, 2, -1};
  expect_same_mesh(io::read_gmsh(in_memory(written(mesh::ElementNodes(mesh, 1), io::write_gmsh4))), mesh);
}

}  // namespace
}  // namespace ccdt
