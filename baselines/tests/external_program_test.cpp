#include "baselines/external_program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace ccdt {
namespace {

constexpr const char* variable = "CCDT_TEST_PROGRAM";

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(FindProgram, LooksOnThePath) {
  unsetenv(variable);
  EXPECT_TRUE(find_program("sh", variable));
  EXPECT_FALSE(find_program("there-is-no-such-program", variable));
}

TEST(FindProgram, TrustsTheEnvironmentVariableFirst) {
  setenv(variable, "/bin/sh", 1);
  EXPECT_EQ(find_program("there-is-no-such-program", variable), "/bin/sh");
  setenv(variable, "/nowhere/sh", 1);
  EXPECT_FALSE(find_program("sh", variable));
  unsetenv(variable);
}

TEST(RunProgram, LogsWhatIsPrintedAndTellsHowItEnded) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  EXPECT_EQ(run_program({"/bin/sh", "-c", "echo out; echo err >&2; exit 3"}, log), 3);
  EXPECT_EQ(text_of(log), "out\nerr\n");
  EXPECT_EQ(run_program({"/bin/sh", "-c", "kill -9 $$"}, log), 128 + 9);
  EXPECT_EQ(run_program({"/nowhere/sh"}, log), 127);
  EXPECT_THROW(run_program({"/bin/sh"}, folder.path() / "nowhere" / "log"), std::system_error);
}

TEST(RunProgram, RunsInAFolderAndWithVariablesOfItsOwn) {
  const TemporaryFolder folder;
  const auto log = folder.path() / "log";
  const ProgramSurroundings there{folder.path(), {{variable, "a word"}, {"HOME", "/nowhere"}}};
  EXPECT_EQ(run_program({"/bin/sh", "-c", "pwd -P; echo \"$CCDT_TEST_PROGRAM $HOME\""}, log, there), 0);
  EXPECT_EQ(text_of(log), std::filesystem::canonical(folder.path()).string() + "\na word /nowhere\n");
  EXPECT_EQ(run_program({"/bin/sh"}, log, {folder.path() / "nowhere", {}}), 127);
}

TEST(TemporaryFolder, IsGoneAfterwards) {
  std::filesystem::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    std::ofstream(path / "file") << "text";
    EXPECT_TRUE(std::filesystem::exists(path / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace ccdt
