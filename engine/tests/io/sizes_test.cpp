#include "engine/io/read_sizes.h"
#include "engine/tests/io/io_test_files.h"

namespace ccdt::io_test {
namespace {

constexpr const char* medit_tetrahedron =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "Tetrahedra\n1\n1 2 3 4 0\nEnd\n";
constexpr const char* medit_surface =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "Triangles\n4\n1 3 2 0\n1 2 4 0\n2 3 4 0\n3 1 4 0\nEnd\n";
constexpr const char* nodes = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";

std::string sol(const std::string& head, const std::string& values) {
  return "MeshVersionFormatted 2\n\nDimension 3\n\nSolAtVertices\n" + head + "\n" + values + "\nEnd\n";
}

/// Expects an error with this line of this file, and with a remedy.
void expect_refused(const std::filesystem::path& file, const std::string& bad_file, long long line) {
  SCOPED_TRACE(bad_file);
  try {
    io::read_sizes(file);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::filesystem::path(error.place().file).filename(), bad_file) << error.what();
    EXPECT_EQ(error.place().line, line) << error.what();
    EXPECT_NE(error.remedy(), "");
  }
}

const std::vector<double> four_sizes = {1, 2.5, 3, 0.25};

TEST(ReadSizes, OfMeditBesideATetrahedralMesh) {
  const Folder folder;
  put(folder / "a.mesh", medit_tetrahedron);
  const auto file = put(folder / "a.sol", sol("4\n1 1", "1 2.5\n3\n0.25"));
  const sizes::BackgroundSizes sizes = io::read_sizes(file);
  EXPECT_EQ(sizes.sizes, four_sizes);
  ASSERT_EQ(sizes.vertices.size(), 4u);
  EXPECT_EQ(sizes.vertices[3], (Point3{0, 0, 1}));
  ASSERT_EQ(sizes.tetrahedra.size(), 1u);
  EXPECT_EQ(sizes.tetrahedra[0], (std::array<std::uint32_t, 4>{0, 1, 2, 3}));
  EXPECT_EQ(sizes.name, file.string());
  EXPECT_EQ(sizes.mesh_name, (folder / "a.mesh").string());
}

TEST(ReadSizes, OfMeditBesideASurfaceHaveNoTetrahedra) {
  const Folder folder;
  put(folder / "a.mesh", medit_surface);
  // As mmg writes it, but without the final End.
  put(folder / "a.sol", "MeshVersionFormatted 2\n\nDimension\n3\n\nSolAtVertices\n4\n1 1 \n1 \n2.5 \n3 \n0.25 \n");
  const sizes::BackgroundSizes sizes = io::read_sizes(folder / "a.sol");
  EXPECT_EQ(sizes.sizes, four_sizes);
  EXPECT_EQ(sizes.vertices.size(), 4u);
  EXPECT_TRUE(sizes.tetrahedra.empty());
}

TEST(ReadSizes, OfTetGenBesideNodesAndElements) {
  const Folder folder;
  put(folder / "part.b.node", nodes);
  const auto file = put(folder / "part.b.mtr", "4 1\n1\n2.5\n3\n0.25\n# made by hand\n");
  EXPECT_EQ(io::read_sizes(file).sizes, four_sizes);
  EXPECT_TRUE(io::read_sizes(file).tetrahedra.empty());
  put(folder / "part.b.ele", "1 4 0\n1 1 2 3 4\n");
  EXPECT_EQ(io::read_sizes(file).tetrahedra.size(), 1u);
}

TEST(ReadSizes, OfTetGenBesideAPlcThatHasItsVertices) {
  const std::string facets = "4 0\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 3 1 4\n0\n0\n";
  for (const std::string ending : {".poly", ".smesh"}) {
    const Folder folder;
    put(folder / ("part" + ending), nodes + facets);
    const sizes::BackgroundSizes sizes = io::read_sizes(put(folder / "part.mtr", "4 1\n1\n2.5\n3\n0.25\n"));
    EXPECT_EQ(sizes.sizes, four_sizes);
    EXPECT_EQ(sizes.vertices.size(), 4u);
    EXPECT_EQ(std::filesystem::path(sizes.mesh_name).filename(), "part" + ending);
  }
}

TEST(ReadSizes, WithoutAMeshBesideThemAreRefused) {
  const Folder folder;
  expect_refused(put(folder / "a.sol", sol("4\n1 1", "1 2 3 4")), "a.sol", 0);
  expect_refused(put(folder / "a.mtr", "4 1\n1\n2\n3\n4\n"), "a.mtr", 0);
  expect_refused(put(folder / "a.txt", "4 1\n1\n2\n3\n4\n"), "a.txt", 0);
  expect_refused(folder / "missing.sol", "missing.sol", 0);
}

TEST(ReadSizes, ThatAreNotOnePositiveNumberPerVertexAreRefusedWithTheLine) {
  const Folder folder;
  put(folder / "a.mesh", medit_tetrahedron);
  const auto refused = [&](const std::string& head, const std::string& values, long long line) {
    SCOPED_TRACE(head + ": " + values);
    expect_refused(put(folder / "a.sol", sol(head, values)), "a.sol", line);
  };
  refused("3\n1 1", "1\n2\n3", 6);                     // another number of vertices
  refused("4\n1 3", "1 0 1 0 0 1\n1 0 1 0 0 1\n", 7);  // a tensor
  refused("4\n1 2", "1 0 1\n1 0 1\n1 1 1\n1 1 1", 7);  // a vector
  refused("4\n2 1 1", "1 2\n1 2\n1 2\n1 2", 7);        // two fields
  refused("4\n1 1", "1\n0\n3\n4", 9);
  refused("4\n1 1", "1\n2\n-3\n4", 10);
  refused("4\n1 1", "1\n2\n3\nnan", 11);
  refused("4\n1 1", "1\n2\ninf\n4", 10);
  refused("4\n1 1", "1 0.5\n2\n3\n4", 11);  // one too many
  refused("4\n1 1", "1\n2\n3", 11);         // 'End' is no number
  expect_refused(put(folder / "a.sol", "MeshVersionFormatted 2\nDimension 3\nEnd\n"), "a.sol", 3);
  expect_refused(put(folder / "a.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n"), "a.sol", 2);
  expect_refused(put(folder / "a.sol", "\x01\x02"), "a.sol", 1);

  put(folder / "b.node", nodes);
  expect_refused(put(folder / "b.mtr", "4 6\n1 0 1 0 0 1\n"), "b.mtr", 1);
  expect_refused(put(folder / "b.mtr", "5 1\n1\n2\n3\n4\n5\n"), "b.mtr", 1);
  expect_refused(put(folder / "b.mtr", "4 1\n1\n2\n3\n0\n"), "b.mtr", 5);
  expect_refused(put(folder / "b.mtr", "4 1\n1\n2\n3\n"), "b.mtr", 5);
  expect_refused(put(folder / "b.mtr", "4 1\n1\n2\nfour\n3\n"), "b.mtr", 4);
}

TEST(ReadSizes, AreRefusedBesideADamagedMeshWhichTheErrorNames) {
  const Folder folder;
  put(folder / "a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 x 0\n0 1 0 0\n0 0 1 0\nEnd\n");
  expect_refused(put(folder / "a.sol", sol("4\n1 1", "1 2 3 4")), "a.mesh", 6);
}

}  // namespace
}  // namespace ccdt::io_test
