#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "baselines/external_program.h"
#include "bench/run/identity.h"

// The id of a case is a hash of all that its caller declares, and of nothing else.

namespace ccdt::bench {
namespace {

/// Files in a folder of their own, which is also the working folder.
class CaseIds : public testing::Test {
 protected:
  CaseIds() {
    write("part.off", "OFF\n");
    std::filesystem::current_path(folder_.path());
  }
  ~CaseIds() override { std::filesystem::current_path(before_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = folder_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

  Case case_of(const std::string& input, std::vector<std::string> options = {}) const {
    return {.name = "case", .group = "group", .input = folder_.path() / input, .options = std::move(options)};
  }

  static std::string id(const Case& asked, const Identity& identity = {{"ccdt.binary", "x"}}) {
    FileHashes hashes;
    return id_of(asked, identity, hashes);
  }

  /// Does the id depend on the contents of this file?
  void expect_change(const Case& asked, const std::string& file) const {
    SCOPED_TRACE(file);
    const std::string before = id(asked);
    write(file, "something else\n");
    EXPECT_NE(id(asked), before);
  }

  /// The identity of a mesher that a file describes.
  Identity described(const std::string& command, const std::string& more = "") const {
    const auto file = write("mine.json", R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher",
      "licence": "MIT", "input_format": "off", "output": "out.vtu", "command": )" +
                                             command + more + "}");
    return identity_of({file.string()}, "/bin/true");
  }

 private:
  baselines::TemporaryFolder folder_;
  std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_F(CaseIds, DependOnTheFileOfSizesAndItsBackground) {
  for (const char* name : {"s.sol", "s.mesh", "t.mtr", "t.node", "t.ele"}) write(name, "as it was\n");
  const Case medit = case_of("part.off", {"--lattice", "bcc", "--sizes", "s.sol"});
  for (const char* name : {"s.sol", "s.mesh"}) expect_change(medit, name);
  const Case tetgen = case_of("part.off", {"--sizes", "t.mtr"});
  for (const char* name : {"t.mtr", "t.node", "t.ele"}) expect_change(tetgen, name);
}

TEST_F(CaseIds, DependOnTheNodeListOfTheInput) {
  for (const char* name : {"part.poly", "part.smesh"}) {
    write(name, "0 3 0 0\n");
    write("part.node", "4 3 0 0\n");
    expect_change(case_of(name), "part.node");
  }
}

TEST_F(CaseIds, DependOnTheFormatOfTheInput) {
  write("part.poly", "4 3 0 0\n");
  write("part.smesh", "4 3 0 0\n");
  EXPECT_NE(id(case_of("part.poly")), id(case_of("part.smesh")));
}

TEST_F(CaseIds, DoNotDependOnOtherFiles) {
  write("own.poly", "4 3 0 0\n");
  const Case one = case_of("part.off", {"--lattice", "bcc", "--edge-length", "0.5"}), other = case_of("own.poly");
  const std::string before = id(one), other_before = id(other);
  for (const char* name : {"bcc", "0.5", "--lattice", "own.node", "part.node", "part.sol", "part.mtr", "sizes"})
    write(name, "unrelated\n");
  EXPECT_EQ(id(one), before);
  EXPECT_EQ(id(other), other_before);
}

TEST_F(CaseIds, DoNotDependOnWhereFilesAre) {
  for (const std::string folder : {"", "moved/"})
    for (const char* name : {"part.off", "s.sol", "s.mesh"}) write(folder + name, name);
  EXPECT_EQ(id(case_of("part.off", {"--sizes", "s.sol"})), id(case_of("moved/part.off", {"--sizes", "moved/s.sol"})));
  write("moved/s.mesh", "another\n");
  EXPECT_NE(id(case_of("part.off", {"--sizes", "s.sol"})), id(case_of("moved/part.off", {"--sizes", "moved/s.sol"})));
}

TEST_F(CaseIds, NoticeThatAFileWasWrittenAnew) {
  FileHashes hashes;
  const Case asked = case_of("part.off");
  const auto id_now = [&] { return id_of(asked, {}, hashes); };
  const std::string first = id_now();
  const auto time = std::filesystem::last_write_time(asked.input);
  write("part.off", "off\n");  // of the same size
  std::filesystem::last_write_time(asked.input, time + std::chrono::seconds(1));
  const std::string second = id_now();
  EXPECT_NE(second, first);
  write("part.off", "longer\n");  // at the same time
  std::filesystem::last_write_time(asked.input, time + std::chrono::seconds(1));
  EXPECT_NE(id_now(), second);
}

TEST_F(CaseIds, DependOnEachLimit) {
  const Case asked = case_of("part.off");
  Case seconds = asked, memory = asked, disk = asked;
  seconds.limits.seconds = memory.limits.memory_bytes = disk.limits.disk_bytes = 5;
  for (const Case& other : {seconds, memory, disk}) EXPECT_NE(id(other), id(asked));
  EXPECT_NE(id(memory), id(disk));
}

TEST_F(CaseIds, DependOnTheDescriptionOfTheMesher) {
  const Identity one = described(R"(["sh"])"), other = described(R"(["sh"])", R"(, "install": "by hand")");
  Case asked = case_of("part.off");
  asked.mesher = "mine.json";
  EXPECT_NE(id(asked, one), id(asked, other));
}

TEST_F(CaseIds, DependOnTheFilesThatTheDescriptionNames) {
  const std::vector<std::string> commands = {R"(["sh", "{here}/mesh.sh", "{input}"])",
                                             R"(["sh", "-c", "exec '{here}/mesh.sh' {input}"])",
                                             R"(["sh", ")" + write("mesh.sh", "").string() + R"("])"};
  Case asked = case_of("part.off");
  asked.mesher = "mine.json";
  for (const std::string& command : commands) {
    SCOPED_TRACE(command);
    write("mesh.sh", "one\n");
    const Identity one = described(command);
    EXPECT_TRUE(one.contains("mine.file mesh.sh"));
    write("unrelated.sh", "two\n");
    EXPECT_EQ(id(asked, described(command)), id(asked, one));
    write("mesh.sh", "two\n");
    EXPECT_NE(id(asked, described(command)), id(asked, one));
  }
  EXPECT_FALSE(described(R"(["sh", "mesh.sh"])").contains("mine.file mesh.sh")) << "it runs in another folder";
}

}  // namespace
}  // namespace ccdt::bench
