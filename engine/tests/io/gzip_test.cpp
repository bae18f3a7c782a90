#include "engine/io/gzip.h"

#include "engine/io/file_sets.h"
#include "engine/tests/io/io_test_files.h"
#include "engine/tests/shared/gzipped.h"

namespace ccdt {
namespace {

using namespace io_test;

TEST(GzipFiles, OfEveryInputFormatAreRead) {
  const Folder folder;
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.poly"}) {
    SCOPED_TRACE(name);
    io::write_plc(awkward_surface(), folder / name);
    const auto packed = put(folder / (std::string(name) + ".gz"), gzipped(bytes_of(folder / name)));
    EXPECT_TRUE(io::is_plc_file(packed));
    expect_same_plc(io::read_plc(packed), io::read_plc(folder / name));
  }
}

TEST(GzipFiles, MayHaveSeveralMembers) {
  const Folder folder;
  const std::string text = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  EXPECT_EQ(io::read_plc(put(folder / "a.off.GZ", gzipped(text) + gzipped(faces))).triangles.size(), 4u);
}

TEST(GzipFiles, LeaveVerticesToTheNodeFileBesideThem) {
  const Folder folder;
  put(folder / "a.node", "3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n");
  const auto file = put(folder / "a.poly.gz", gzipped("0 3 0 0\n1 0\n1\n3 0 1 2\n0\n0\n"));
  EXPECT_EQ(io::read_plc(file).vertices.size(), 3u);
  EXPECT_EQ(io::files_of_plc(file), (std::vector<std::filesystem::path>{file, folder / "a.node"}));
}

TEST(GzipFiles, AreRefusedIfDamagedOrTooLarge) {
  const std::string whole = gzipped("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  for (std::size_t size = 1; size < whole.size(); ++size) expect_refused("a.off.gz", whole.substr(0, size), {});
  std::string changed = whole;
  changed[changed.size() / 2] ^= 1;
  expect_refused("a.off.gz", changed, {});
  expect_refused("a.off.gz", whole + "rest", {});
  expect_refused("a.off.gz", gzipped(""), {});
  expect_refused("a.off.gz", gzipped("OFF\n" + std::string(1'000'000, ' ') + "0 0 0\n"), {"100"});
  expect_refused("a.gz", whole, {});
  expect_refused("a.vtk.gz", whole, {});
}

}  // namespace
}  // namespace ccdt
