#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Files that other programs write, and that are not quite in their format.

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const Triangles one_triangle = {{0, 1, 2}};

TEST(UnusualFiles, AByteOrderMarkBeginsAnyText) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const auto& [name, text] : std::vector<std::array<std::string, 2>>{
           {"a.stl", "solid x\n" + facet + "endsolid\n"},
           {"a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
           {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
           {"a.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
           {"a.mesh",
            "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles 1\n"
            "1 2 3 0\nEnd\n"}}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(plc_of(name, mark + text).triangles, one_triangle);
    EXPECT_TRUE(plc_of(name, mark + text).notes.empty());
  }
  io_test::expect_refused("a.off", mark + "OFF 1 0 0\n0 0 zero\n", {"'zero'", 2});
}

TEST(UnusualFiles, StlWithoutEndsolidIsReadWithANote) {
  const plc::InputPlc cut = plc_of("a.stl", "solid x\n" + facet + facet);
  EXPECT_EQ(cut.triangles.size(), 2u);
  EXPECT_EQ(cut.notes.size(), 1u);
  for (const std::string end : {"endsolid", "endsolid x\n", "end solid\n", "End Solid x\n"})
    EXPECT_TRUE(plc_of("a.stl", "solid x\n" + facet + end).notes.empty()) << end;
  EXPECT_EQ(plc_of("a.stl", "solid x\n" + facet + "end solid\nsolid y\n" + facet + "end solid\n").triangles.size(), 2u);
  // What ends within a facet, or before the first one, was cut off.
  for (const std::string& part :
       std::vector<std::string>{"", "facet normal 0 0 1\n", facet.substr(0, facet.find("endfacet"))})
    io_test::expect_refused("a.stl", "solid x\n" + part, {});
}

TEST(UnusualFiles, MeditWithoutEndIsReadWithANote) {
  const plc::InputPlc plc = plc_of(
      "a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 3\n0 0 0 0\n1 0 0 0\n0 1 0 0\nTriangles 1\n1 2 3 0\n");
  EXPECT_EQ(plc.triangles, one_triangle);
  EXPECT_EQ(plc.notes.size(), 1u);
}

TEST(UnusualFiles, MeditOfTetrahedraAloneMayLackItsEndToo) {
  const plc::InputPlc plc = plc_of("a.mesh",
                                   "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
                                   "0 0 1 0\nTetrahedra 1\n1 2 3 4 0\n");
  EXPECT_EQ(plc.triangles.size(), 4u);
  EXPECT_EQ(plc.notes.size(), 2u);
}

TEST(UnusualFiles, TheCountOfAnOffMayFollowItsKeywordAtOnce) {
  const std::string rest = " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const std::string head : {"OFF3", "COFF3", "off3"})
    EXPECT_EQ(plc_of("a.off", head + rest).triangles, one_triangle) << head;
  for (const std::string head : {"4OFF3", "OFFX3"}) io_test::expect_refused("a.off", head + rest, {{}, 1});
}

TEST(UnusualFiles, TheKeywordTellsTheFormatIfTheEndingIsWrong) {
  const std::string stl = "solid x\n" + facet + "endsolid\n", off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const auto& [name, text] : std::vector<std::array<std::string, 2>>{
           {"a.obj", stl}, {"a.off", stl}, {"a.stl", off}, {"a.ply", off}, {"a.poly", off}}) {
    SCOPED_TRACE(name);
    const plc::InputPlc plc = plc_of(name, text);
    EXPECT_EQ(plc.triangles, one_triangle);
    EXPECT_EQ(plc.notes.size(), 1u);
  }
  EXPECT_TRUE(plc_of("a.stl", stl).notes.empty());
}

TEST(UnusualFiles, StripsOfTrianglesInPly) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
  EXPECT_EQ(plc_of("a.ply", head + "9 0 1 2 3 4 -1 4 3 2\n").triangles,
            (Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 2}}))
      << "every second triangle of a strip is turned, and -1 begins a new strip";
  EXPECT_TRUE(plc_of("a.ply", head + "4 0 1 -1 3\n").triangles.empty());
  io_test::expect_refused("a.ply", head + "3 0 1 5\n", {"5"});
  io_test::expect_refused("a.ply", head + "3 0 1 -2\n", {"-2"});
}

TEST(UnusualFiles, TheBoundaryOfTetrahedraIsASurface) {
  mesh::TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  mesh.regions = {2, 2};
  const Folder folder;
  for (const char* name : {"a.mesh", "a.meshb"}) {
    SCOPED_TRACE(name);
    io::write_tet_mesh(mesh, folder / name);
    const plc::InputPlc plc = io::read_plc(folder / name);
    EXPECT_EQ(plc.notes.size(), 1u);
    ASSERT_EQ(plc.regions.size(), 1u);
    EXPECT_EQ(plc.regions[0].attribute, 2);
    EXPECT_EQ(plc.triangles.size(), 6u) << "all faces but the one between the two";
    double sixfold = 0;
    for (const auto& [a, b, c] : plc.triangles)
      sixfold += dot(plc.vertices[a], cross(plc.vertices[b], plc.vertices[c]));
    EXPECT_DOUBLE_EQ(sixfold, 3) << "they face outward: 1/6 and 1/3";
  }
}

TEST(MalformedFiles, PlyElementsMustBeWhatTheyClaim) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  io_test::expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\n" + faces + "3 0 1 2\n", {"'x'"});
  io_test::expect_refused("a.ply",
                          "ply\nformat ascii 1.0\nelement vertex 4000000\nelement vertex 4\nproperty float x\n"
                          "property float y\nproperty float z\n" +
                              faces,
                          {"'vertex'", 4});
}

/// A .meshb with this many sections of vertices, each of which claims everything up to the end of the file.
std::string overlapping_sections(int sections) {
  std::string bytes;
  const auto add = [&](std::int32_t number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
  for (const std::int32_t number : {1, 2, 3, 20, 3}) add(number);
  constexpr std::int32_t vertices = 4, bytes_each = 28, head = 12;
  const std::int32_t end = 20 + head * sections;
  for (std::int32_t s = 0; s < sections; ++s) {
    add(vertices);
    add(20 + head * (s + 1));
    add((end - 20 - head * (s + 1)) / bytes_each);
  }
  for (const std::int32_t number : {54, 0}) add(number);
  return bytes;
}

TEST(MalformedFiles, MeditSectionsDoNotOverlap) {
  io_test::expect_refused("a.meshb", overlapping_sections(100), {});
}

/// The outline of a frame, with a bridge from its outer square to its hole; the corners of the bridge are there twice.
const std::vector<std::array<int, 2>> frame = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1},
                                               {1, 2}, {2, 2}, {3, 2}, {3, 3}, {0, 3}};

/// An extruded outline, as a file in OFF.
std::string extruded(const std::vector<std::array<int, 2>>& outline) {
  const std::size_t n = outline.size();
  std::string vertices, bottom = std::to_string(n), top = bottom, walls;
  for (const int z : {0, 1})
    for (const auto& [x, y] : outline)
      vertices += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    bottom += " " + std::to_string(n - 1 - i);
    top += " " + std::to_string(n + i);
    walls += "4 " + std::to_string(i) + " " + std::to_string(next) + " " + std::to_string(n + next) + " " +
             std::to_string(n + i) + "\n";
  }
  return "OFF " + std::to_string(2 * n) + " " + std::to_string(n + 2) + " 0\n" + vertices + bottom + "\n" + top + "\n" +
         walls;
}

TEST(UnusualFiles, WallsOnBothSidesOfABridgeBoundNothing) {
  const plc::InputPlc plc = plc_of("a.off", extruded(frame));
  EXPECT_EQ(plc.polygon_facets.size(), frame.size());
  EXPECT_EQ(plc.notes.size(), 1u);
  EXPECT_TRUE(std::ranges::none_of(plc.polygon_facets, [](const auto& f) { return f.number == 4 || f.number == 9; }));
}

TEST(UnusualFiles, WallsBetweenSolidsThatTouchStay) {
  const plc::InputPlc plc = plc_of("a.obj",
                                   "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                   "f 1 2 6 5\nf 5 6 2 1\n");
  EXPECT_EQ(plc.polygon_facets.size(), 2u);
  EXPECT_TRUE(plc.notes.empty());
}

}  // namespace
}  // namespace ccdt
