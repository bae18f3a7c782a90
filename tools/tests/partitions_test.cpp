#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

constexpr int tetrahedron_type = 4;

/// How many tetrahedra of a text of Gmsh's version 2.2 are in each partition.
std::map<int, int> partition_sizes(const std::string& msh) {
  std::istringstream text(msh.substr(msh.find("$Elements") + 9));
  std::map<int, int> sizes;
  std::size_t count = 0;
  text >> count;
  std::string line;
  std::getline(text, line);
  for (std::size_t i = 0; i < count && std::getline(text, line); ++i) {
    std::istringstream words(line);
    int number = 0, type = 0, tags = 0, physical = 0, elementary = 0, partitions = 0, partition = 0;
    words >> number >> type >> tags >> physical >> elementary >> partitions >> partition;
    EXPECT_EQ(tags, 4) << line;
    EXPECT_EQ(partitions, 1) << line;
    if (type == tetrahedron_type) ++sizes[partition];
  }
  return sizes;
}

TEST_F(Program, MeshIsDividedIntoPartitionsOfAboutTheSameSize) {
  ASSERT_EQ(run("model sphere --edge-length 0.2 -o ball.off").exit_code, 0);
  for (const int count : {1, 2, 5}) {
    const std::string options = " --partitions " + std::to_string(count);
    ASSERT_EQ(run("mesh ball.off -o ball.msh" + options).exit_code, 0);
    const std::map<int, int> sizes = partition_sizes(text_of(work() / "ball.msh"));
    ASSERT_EQ(sizes.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(sizes.begin()->first, 1);
    EXPECT_EQ(sizes.rbegin()->first, count);
    int sum = 0, most = 0;
    for (const auto& [partition, size] : sizes) sum += size, most = std::max(most, size);
    EXPECT_LE(most, 1.03 * sum / count + 1) << "METIS promises 3%";
    EXPECT_EQ(run("verify ball.off ball.msh").exit_code, 0);
    ASSERT_EQ(run("mesh ball.off -o again.msh" + options).exit_code, 0);
    EXPECT_EQ(text_of(work() / "ball.msh"), text_of(work() / "again.msh"));
    for (const std::string file : {"ball.msh4", "ball.vtu"}) {
      ASSERT_EQ(run("mesh ball.off -o " + file + options).exit_code, 0);
      EXPECT_EQ(run("verify ball.off " + file).exit_code, 0) << file;
    }
  }
}

TEST_F(Program, PartitionsNeedAFormatThatHoldsThemAndEnoughTetrahedra) {
  ASSERT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  EXPECT_EQ(run("mesh cube.off -o cube.mesh --partitions 2").exit_code, 3);
  EXPECT_EQ(run("mesh cube.off -o cube.msh --partitions 0").exit_code, 2);
  EXPECT_EQ(run("mesh cube.off -o cube.msh --partitions 1000").exit_code, 4);
  EXPECT_EQ(file_count(), 1u);
  EXPECT_EQ(run("mesh cube.off -o cube.msh --partitions 2 --order 2").exit_code, 0);
}

}  // namespace
}  // namespace ccdt
