#include "engine/io/file_sets.h"

#include "engine/tests/io/io_test_files.h"

namespace ccdt::io_test {
namespace {

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.filename().string());
  return names;
}

using Names = std::vector<std::string>;

TEST(FilesOfPlc, AreThoseThatAreRead) {
  const Folder folder;
  put(folder / "a.node", "4 3 0 0\n");
  for (const std::string name : {"a.poly", "a.smesh"}) {
    const auto file = put(folder / name, "# made by hand\n\n  0 3 0 0\n");
    EXPECT_EQ(names_of(io::files_of_plc(file)), (Names{name, "a.node"}));
    put(file, "# made by hand\n4 3 0 0\n");
    EXPECT_EQ(names_of(io::files_of_plc(file)), Names{name}) << "its vertices are in the file itself";
  }
  EXPECT_EQ(names_of(io::files_of_plc(put(folder / "a.off", "0\n"))), Names{"a.off"});
  EXPECT_EQ(names_of(io::files_of_plc(folder / "missing.poly")), Names{"missing.poly"});
}

TEST(FilesOfPlc, IncludeANodeListThatIsMissing) {
  const Folder folder;
  EXPECT_EQ(names_of(io::files_of_plc(put(folder / "a.poly", "0 3 0 0\n"))), (Names{"a.poly", "a.node"}));
}

TEST(FilesOfSizes, AreThoseThatAreRead) {
  const Folder folder;
  const auto sol = put(folder / "a.sol", ""), mtr = put(folder / "a.mtr", "");
  EXPECT_EQ(names_of(io::files_of_sizes(sol)), Names{"a.sol"});
  EXPECT_EQ(names_of(io::files_of_sizes(mtr)), Names{"a.mtr"});
  for (const char* name : {"a.mesh", "a.poly", "a.ele"}) put(folder / name, "");
  EXPECT_EQ(names_of(io::files_of_sizes(sol)), (Names{"a.sol", "a.mesh"}));
  EXPECT_EQ(names_of(io::files_of_sizes(mtr)), (Names{"a.mtr", "a.poly"}));
  put(folder / "a.node", "");
  EXPECT_EQ(names_of(io::files_of_sizes(mtr)), (Names{"a.mtr", "a.node", "a.ele"}));
}

}  // namespace
}  // namespace ccdt::io_test
