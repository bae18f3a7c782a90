#include "tools/tests/program.h"

namespace ccdt {
namespace {

TEST_F(Program, QuietVerbsSayNothingIfAllIsWell) {
  for (const std::string arguments :
       {"model cube --edge-length 0.5 -o cube.off", "mesh cube.off -o cube.mesh", "improve cube.mesh -o better.mesh",
        "check cube.off", "check cube.off --repair -o copy.off", "verify cube.off cube.mesh",
        "mesh cube.off -o cube.mesh --report r.json", "gate r.json --against r.json"}) {
    const Outcome outcome = run(arguments + " --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "") << arguments;
  }
}

TEST_F(Program, QuietVerbsSayWhatIsWrong) {
  ASSERT_EQ(run("model cube --edge-length 0.5 -o cube.off -q").exit_code, 0);
  ASSERT_EQ(run("model cube --edge-length 0.25 -o other.off -q").exit_code, 0);
  ASSERT_EQ(run("mesh cube.off -o cube.mesh -q").exit_code, 0);
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  for (const auto& [arguments, code] :
       std::vector<std::pair<std::string, int>>{{"check open.off", 3},
                                                {"mesh open.off -o a.mesh", 3},
                                                {"verify other.off cube.mesh", 1},
                                                {"gate r.json --against other.json", 3},
                                                {"mesh cube.off -o a.mesh --require-r 1", 1}}) {
    const Outcome outcome = run(arguments + " -q");
    EXPECT_EQ(outcome.exit_code, code) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
}

TEST_F(Program, HelpAndVersionAreVerbsAsWellAsOptions) {
  EXPECT_EQ(run("help").out, run("--help").out);
  for (const std::string verb : {"mesh", "gate", "completion"})
    EXPECT_EQ(run("help " + verb).out, run(verb + " --help").out);
  EXPECT_EQ(run("version").out, run("--version").out);
  EXPECT_EQ(run("help frobnicate").exit_code, 2);
  EXPECT_EQ(run("version").exit_code, 0);
}

}  // namespace
}  // namespace ccdt
