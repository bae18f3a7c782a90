#include <algorithm>
#include <cstring>

#include "engine/tests/io/io_test_files.h"

namespace ccdt {
namespace {

using namespace io_test;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Loops = std::vector<std::vector<std::uint32_t>>;

std::string binary_stl(std::string header, std::uint32_t claimed, std::size_t written) {
  header.resize(80, '\0');
  header.append(reinterpret_cast<const char*>(&claimed), 4);
  for (std::size_t i = 0; i < written; ++i) {
    const float values[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(i)};
    header.append(reinterpret_cast<const char*>(values), sizeof values);
    header.append(2, '\0');
  }
  return header;
}

TEST(ReadStl, BinaryMayBeginWithSolid) {
  const plc::InputPlc plc = plc_of("a.stl", binary_stl("solid part", 2, 2));
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(plc.vertices.size(), 4u) << "equal vertices are one";
}

TEST(ReadStl, TextOfSeveralSolidsInAnyCase) {
  const plc::InputPlc plc =
      plc_of("A.STL",
             "  SOLID  a strange solid name\r\n FACET NORMAL nan nan nan\r\nouter loop\n"
             "vertex 0 0 0\nvertex +1.5e0 0 0\nvertex 0 1 -0\nendloop\nendfacet\nENDSOLID a b\n"
             "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1.5 0 0 vertex 0 0 1 endloop "
             "endfacet\nendsolid");
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(plc.vertices[1].x, 1.5);
}

TEST(ReadStl, NamedSolidsBecomeMarkers) {
  const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
  const auto solid = [&](const std::string& name) { return "solid " + name + "\n" + facet + "endsolid\n"; };
  const plc::InputPlc plc = plc_of("a.stl", solid("inlet") + solid("7") + solid("side wall") + solid("inlet"));
  EXPECT_EQ(plc.triangle_markers, (std::vector<int>{1, 7, 2, 1}));
  EXPECT_EQ(plc.marker_names, (std::map<int, std::string>{{1, "inlet"}, {2, "side wall"}}));
  for (const std::string& one : {solid("part"), solid("part") + solid("part"), solid("") + solid("")}) {
    EXPECT_TRUE(plc_of("a.stl", one).triangle_markers.empty());
    EXPECT_TRUE(plc_of("a.stl", one).marker_names.empty());
  }
}

TEST(ReadStl, ErrorsHaveTheirPlace) {
  expect_refused("a.stl", binary_stl("x", 3, 2), {"234", {}, 184, 2});
  expect_refused("a.stl", binary_stl("solid x", 3, 2), {"3", {}, 184, 2});
  expect_refused("a.stl", binary_stl("x", 0xFFFFFFFFu, 1), {"4294967295", {}, {}, {}});
  expect_refused("a.stl", binary_stl("x", 1, 3), {{}, {}, 134});
  expect_refused("a.stl", std::string(50, '\0'), {"84", {}, 50});
  std::string with_nan = binary_stl("x", 2, 2);
  const float nan = NAN;
  std::memcpy(with_nan.data() + 84 + 50 + 12 + 16, &nan, 4);
  expect_refused("a.stl", with_nan, {{}, {}, 162, 1});
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  expect_refused("a.stl", "solid\n" + facet + "facet normal\n", {{}, 10, {}, 1});
  expect_refused("a.stl", "solid\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0 inf 0\n", {"'inf'", 11, {}, 1});
  expect_refused("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", {"'zero'", 4, {}, 0});
  expect_refused("a.stl", "solid\nfacett normal 0 0 1\nouter loop\n", {"'facet'", 3, {}, 0});
}

constexpr const char* stl_facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

TEST(ReadStl, SkipsNamesAndCommentsBetweenFacets) {
  const std::string facet = std::string(stl_facet) + "endloop foo\nendfacet bar\n";
  const plc::InputPlc plc =
      plc_of("a.stl", "solid\n# no facet\n" + facet + "this is\n\nan outer wall\n" + facet + "endsolid");
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}}));
}

TEST(ReadStl, CarriageReturnsEndLinesIfNothingElseDoes) {
  std::string text =
      std::string("solid of a facet\n# no facet\n") + stl_facet + "endloop\nendfacet\nendsolid a solid\n";
  std::ranges::replace(text, '\n', '\r');
  EXPECT_EQ(plc_of("a.stl", text).triangles, (Triangles{{0, 1, 2}}));
}

TEST(ReadOff, HeadersCommentsExtrasAndMissingEdgeCount) {
  for (const std::string head : {"OFF\n3 2 0\n", "# c\nOFF 3 2\n", "COFF\n# c\n3 2 0 # c\n", "NOFF\n3 2 0\n",
                                 "STOFF\n\n3 2 0\n", "STCNOFF 3 2 0\n", "3 2 0\n", "off\r\n3 2 0\r\n"}) {
    SCOPED_TRACE(head);
    const plc::InputPlc plc =
        plc_of("a.off", head + "0 0 0 255 0 0 255\n# c\n1 0 0 0.5 # c\n0 1 0\n3 0 1 2 0.5 0.5 0\n3 2 1 0");
    EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {2, 1, 0}}));
    EXPECT_EQ(plc.vertices, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_TRUE(plc.triangle_numbers.empty());
  }
}

TEST(ReadOff, FacesOfAnySizeKeepTheirNumbers) {
  const plc::InputPlc plc =
      plc_of("a.off", "OFF\n4 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 2\n2 0 2\n1 3\n3 3 2 1\n");
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {3, 2, 1}}));
  EXPECT_EQ(plc.triangle_numbers, (std::vector<std::uint32_t>{1, 4}));
  ASSERT_EQ(plc.polygon_facets.size(), 1u);
  EXPECT_EQ(plc.polygon_facets[0].polygons, (Loops{{0, 1, 2, 3}}));
  EXPECT_EQ(plc.polygon_facets[0].number, 0u);
  EXPECT_EQ(plc.segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 2}}));
}

TEST(ReadOff, KeepsNonManifoldFaces) {
  const plc::InputPlc plc =
      plc_of("a.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n");
  EXPECT_EQ(plc.triangles.size(), 3u);
}

TEST(ReadOff, ErrorsHaveTheirPlace) {
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", {"'nan'", 4});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", {"'1e999'", 4});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", {"3", 6, {}, 0});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n", {"-1", 6, {}, 0});
  expect_refused("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {{}, 7, {}, 1});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n", {"1", 7});
  expect_refused("a.off", "OFF\n90000000 90000000 0\n0 0 0\n", {"90000000", 2});
  expect_refused("a.off", "OFF\n3 4000000000 0\n0 0 0\n1 0 0\n0 1 0\n", {"4000000000", 2});
  expect_refused("a.off", "OFF\n1 99999999999 0\n0 0 0\n", {"4294967294", 2});
  expect_refused("a.off", "OFF\n-3 1 0\n", {{}, 2});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n200000 0 1 2\n", {"200000", 6, {}, 0});
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0x\n0 1 0\n", {"'0x'", 4});
  expect_refused("a.off", "4OFF\n3 1 0\n", {"'4'", 1});
  expect_refused("a.off", "OFF BINARY\n3 1 0\n", {{}, 1});
  expect_refused("a.off", "other\n", {"'OFF'", 1});
}

TEST(ReadObj, FormsOfCornersNegativeIndicesAndJoinedLines) {
  const plc::InputPlc plc =
      plc_of("a.obj",
             "# c\nmtllib x.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\n"
             "f 1/1/1 2//1 3/1 # c\nv 0 0 1\nf -4 \\\n -3 \\\r\n -1\nusemtl m \\\n f 1 2 3\ns off\nf 1 2 3 4\nl 1 2\n");
  EXPECT_EQ(plc.vertices.size(), 4u);
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
  ASSERT_EQ(plc.polygon_facets.size(), 1u);
  EXPECT_EQ(plc.polygon_facets[0].number, 2u);
  EXPECT_TRUE(plc.triangle_markers.empty());
}

TEST(ReadObj, GroupsBecomeMarkers) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", face = "f 1 2 3\n";
  const plc::InputPlc plc = plc_of(
      "a.obj", vertices + face + "g top side\n" + face + "o 1\n" + face + "g bottom\n" + face + "g top side\n" + face);
  EXPECT_EQ(plc.triangle_markers, (std::vector<int>{0, 2, 1, 3, 2}));
  EXPECT_EQ(plc.marker_names, (std::map<int, std::string>{{2, "top side"}, {3, "bottom"}}));
}

TEST(ReadObj, ErrorsHaveTheirPlace) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refused("a.obj", vertices + "f 1 2 3\nf 1 2 4\n", {"4", 5, {}, 1});
  expect_refused("a.obj", vertices + "f 1 2 0\n", {"0", 4, {}, 0});
  expect_refused("a.obj", vertices + "f 1 2 -4\n", {"-4", 4, {}, 0});
  expect_refused("a.obj", vertices + "f 1 2\n", {{}, 4, {}, 0});
  expect_refused("a.obj", vertices + "f 1 2 x/1\n", {"'x/1'", 4, {}, 0});
  expect_refused("a.obj", "v 0 0 0\nv 0 -inf 0\n", {"'-inf'", 2});
  expect_refused("a.obj", "v 0 0 0\nv 0 1", {"1", 2});
}

const std::string ply_text_head =
    "ply\nformat ascii 1.0\ncomment c\nelement face 2\nproperty uchar quality\nproperty list uchar int vertex_index\n"
    "element edge 1\nproperty int a\nproperty list int float b\nelement vertex 4\nproperty float z\nproperty float nx\n"
    "property double y\nproperty int x\nend_header\n";

TEST(ReadPly, TextWithPropertiesInAnyOrder) {
  const plc::InputPlc plc =
      plc_of("a.ply", ply_text_head + "9 3 0 1 2\n9 4 0 1 2 3\n7 2 nan 0.5\n0.5 nan 2 1\n0 0 0 0\n0 0 0 1\n0 0 1 1\n");
  EXPECT_EQ(plc.vertices[0], (Point3{1, 2, 0.5}));
  EXPECT_EQ(plc.triangles, (Triangles{{0, 1, 2}}));
  ASSERT_EQ(plc.polygon_facets.size(), 1u);
  EXPECT_EQ(plc.polygon_facets[0].number, 1u);
}

template <class T>
void append(std::string& bytes, T value, bool big) {
  char digits[sizeof value];
  std::memcpy(digits, &value, sizeof value);
  if (big) std::reverse(digits, digits + sizeof value);
  bytes.append(digits, sizeof value);
}

std::string binary_ply(bool big, double z, short index) {
  std::string bytes =
      std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\r\nelement vertex 3\r\nproperty float32 x\r\nproperty int16 y\r\nproperty uint8 red\r\n"
      "property float64 z\r\nelement face 1\r\nproperty list uint32 int16 vertex_indices\r\nend_header\r\n";
  for (int i = 0; i < 3; ++i) {
    append(bytes, 0.5f, big), append(bytes, static_cast<short>(-2), big), append(bytes, '\x7', big),
        append(bytes, i == 2 ? z : 0.1, big);
  }
  append(bytes, 3u, big);
  for (const short v : {short{2}, short{1}, index}) append(bytes, v, big);
  return bytes;
}

TEST(ReadPly, BinaryOfBothByteOrdersAndMixedTypes) {
  for (const bool big : {false, true}) {
    const plc::InputPlc plc = plc_of("a.ply", binary_ply(big, 0.1, 0) + "\n");
    EXPECT_EQ(plc.vertices[2], (Point3{0.5, -2, 0.1}));
    EXPECT_EQ(plc.triangles, (Triangles{{2, 1, 0}}));
  }
}

TEST(ReadPly, ErrorsHaveTheirPlace) {
  const std::string good = binary_ply(false, 0.1, 0);
  const long long end = static_cast<long long>(good.size());
  expect_refused("a.ply", binary_ply(false, INFINITY, 0), {"2", {}, end - 18});
  expect_refused("a.ply", binary_ply(false, 1, 3), {"3", {}, end - 2, 0});
  expect_refused("a.ply", binary_ply(false, 1, -1), {"-1", {}, end - 2, 0});
  expect_refused("a.ply", good.substr(0, good.size() - 1), {"0", {}, end - 1, 0});
  expect_refused("a.ply", good + "more", {{}, {}, end});
  std::string claims = good;
  claims.replace(claims.find("vertex 3"), 8, "vertex 4000000000");
  expect_refused("a.ply", claims, {"60000000004"});
  std::string list = good;
  std::memset(list.data() + list.size() - 10, 0x7f, 4);
  expect_refused("a.ply", list, {"2139062143", {}, end - 10, 0});
  expect_refused("a.ply", ply_text_head + "9 3 0 1 9\n" + std::string(44, '9'), {"9", 16, {}, 0});
  expect_refused("a.ply", ply_text_head + "9 3 0 1 2\n9 2 0 1\n9 9 9 9 9 9 9 9 9 9 9 9 9 9 9", {{}, 17, {}, 1});
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", {"'y'"});
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", {"'real'", 4});
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement", {{}, 3});
  expect_refused("a.ply", "solid\n", {"'ply'", 1});
  expect_refused(
      "a.ply",
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n3 0 1 2\n", {});
}

TEST(ReadPlc, RefusesWhatIsNoFile) {
  const Folder folder;
  const auto read = [&](const std::string& name) { return [&folder, name] { io::read_plc(folder / name); }; };
  put(folder / "a.step", "x");
  for (const std::string ending : {".stl", ".off", ".obj", ".ply", ".poly", ".smesh", ".node", ".mesh"}) {
    put(folder / ("empty" + ending), "");
    std::filesystem::create_directory(folder / ("folder" + ending));
    expect_input_error(read("empty" + ending), {});
    expect_input_error(read("folder" + ending), {});
    expect_input_error(read("missing" + ending), {});
  }
  expect_input_error(read("a.step"), {"'.step'"});
  expect_input_error(read("missing.step"), {});
  expect_input_error([] { io::read_plc("/dev/null"); }, {});
}

TEST(ReadPlc, NoFacetsAreNoErrorHere) {
  EXPECT_EQ(plc_of("a.off", "OFF\n0 0 0\n").facet_count(), 0u);
  EXPECT_EQ(plc_of("a.obj", "# nothing\n").facet_count(), 0u);
  EXPECT_EQ(plc_of("a.stl", "solid x\nendsolid x\n").facet_count(), 0u);
}

TEST(ReadPlc, TellsTheNameOfTheFile) {
  const Folder folder;
  EXPECT_EQ(io::read_plc(put(folder / "a.off", "OFF\n0 0 0\n")).name, (folder / "a.off").string());
}

}  // namespace
}  // namespace ccdt
