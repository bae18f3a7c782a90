#include "baselines/external_program.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace ccdt {
namespace {

constexpr const char* variable = "CCDT_TEST_PROGRAM";

TEST(FindProgram, LooksOnThePath) {
  unsetenv(variable);
  EXPECT_TRUE(baselines::find_program("sh", variable));
  EXPECT_FALSE(baselines::find_program("there-is-no-such-program", variable));
}

TEST(FindProgram, TrustsTheEnvironmentVariableFirst) {
  setenv(variable, "/bin/sh", 1);
  EXPECT_EQ(baselines::find_program("there-is-no-such-program", variable), "/bin/sh");
  setenv(variable, "/nowhere/sh", 1);
  EXPECT_FALSE(baselines::find_program("sh", variable));
  unsetenv(variable);
}

TEST(ProgramLog, AddsWhatMatchesAndQuotesTheEnd) {
  const baselines::TemporaryFolder folder;
  const auto log = folder.path() / "log";
  std::ofstream(log) << "a: 1.5 s\n\n" << std::string(1000000, 'x') << "\nb: 2e-1 s\n1\n2\n3\n4  \n\n5";
  EXPECT_DOUBLE_EQ(baselines::sum_in_log(log, ": ([0-9.e-]+) s").value_or(0), 1.7);
  EXPECT_FALSE(baselines::sum_in_log(log, "hours"));
  EXPECT_EQ(baselines::last_lines(log), "1 | 2 | 3 | 4 | 5");
}

TEST(TemporaryFolder, IsGoneAfterwards) {
  std::filesystem::path path;
  {
    const baselines::TemporaryFolder folder;
    path = folder.path();
    std::ofstream(path / "file") << "text";
    EXPECT_TRUE(std::filesystem::exists(path / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace ccdt
