#include "bench/gate/timed_targets.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "baselines/external_program.h"
#include "engine/base/errors.h"

namespace ccdt::gate {
namespace {

/// Programs are shell scripts, which note their arguments and the length of the padding.
class TimedTargets : public testing::Test {
 protected:
  std::filesystem::path script(const std::string& name, const std::string& text) const {
    const auto file = folder_.path() / name;
    std::ofstream(file) << "#!/bin/sh\necho \"$0 $*\" >> " << calls_file()
                        << "\nprintf %s \"$CCDT_GATE_PADDING\" | wc -c > " << (folder_.path() / "padding") << "\n"
                        << text;
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }

  /// Stands for `ccdt mesh ... --report FILE`.
  std::filesystem::path mesher(const std::string& name, const std::string& report, const std::string& rest = "") const {
    return script(name, "while [ \"$1\" != --report ]; do shift; done\necho '" + report + "' > \"$2\"\n" + rest);
  }

  /// Stands for a program on Google Benchmark.
  std::filesystem::path benchmark(const std::string& name, const std::string& runs) const {
    return script(name, "for a; do case $a in --benchmark_out=*) echo '{\"benchmarks\": [" + runs +
                            "]}' > \"${a#*=}\";; esac; done\n");
  }

  std::filesystem::path calls_file() const { return folder_.path() / "calls"; }

  std::string last_call() const {
    std::ifstream file(calls_file());
    std::string line, last;
    while (std::getline(file, line)) last = line;
    return last;
  }

  cases::Case part() const {
    const auto input = folder_.path() / "part.off";
    std::ofstream(input) << "OFF";
    return {.name = "part", .group = "parts", .input = input, .options = {"--lattice", "bcc"}};
  }

  baselines::TemporaryFolder folder_;
};

constexpr const char* report = R"({"schema": "ccdt.run/1", "seconds": {"mesh": 0.5, "delaunay": 0.25}})";

TEST_F(TimedTargets, ACaseOfASweepIsTimedByItsReport) {
  const Programs programs = {mesher("old", report), mesher("new", report)};
  Rules rules;
  rules.special.push_back({"other", rules.time});
  rules.special.back().time.figure = "seconds.delaunay";
  cases::Case other = part();
  other.name = "other";
  const auto targets = sweep_targets(programs, std::vector{part(), other}, rules, folder_.path());
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0].run({Side::base, 100}).at("part"), 0.5);
  EXPECT_NE(last_call().find("/old mesh"), std::string::npos);
  EXPECT_NE(last_call().find("--lattice bcc"), std::string::npos);
  EXPECT_EQ(targets[1].run({Side::head, 0}).at("other"), 0.25);
  EXPECT_NE(last_call().find("/new mesh"), std::string::npos);
  const std::string command = targets[1].command(Side::head, "other");
  EXPECT_NE(command.find(programs.head.string()), std::string::npos);
  EXPECT_NE(command.find((folder_.path() / "part.off").string()), std::string::npos);
}

TEST_F(TimedTargets, TheEnvironmentIsLargerByThePadding) {
  const auto program = mesher("same", report);
  const auto targets = sweep_targets({program, program}, std::vector{part()}, {}, folder_.path());
  for (const std::size_t padding : {0, 1234}) {
    targets.front().run({Side::base, padding});
    std::size_t seen = 1;
    std::ifstream(folder_.path() / "padding") >> seen;
    EXPECT_EQ(seen, padding);
  }
}

TEST_F(TimedTargets, AProgramThatFailsIsNamedWithItsSideAndWhatItPrinted) {
  const Programs programs = {mesher("old", report), mesher("new", report, "echo no memory for faces >&2\nexit 4")};
  const auto targets = sweep_targets(programs, std::vector{part()}, {}, folder_.path());
  EXPECT_NO_THROW(targets.front().run({Side::base, 0}));
  try {
    targets.front().run({Side::head, 0});
    FAIL() << "the program exits with 4";
  } catch (const ProgramFailed& e) {
    EXPECT_EQ(e.side(), Side::head);
    EXPECT_EQ(e.place().file, programs.head.string());
    EXPECT_NE(std::string(e.what()).find("no memory for faces"), std::string::npos);
    EXPECT_NE(e.remedy().find("--lattice bcc"), std::string::npos);
  }
}

TEST_F(TimedTargets, AReportWithoutTheFigureIsAnError) {
  const auto program = mesher("same", R"({"schema": "ccdt.run/1", "seconds": {}})");
  const auto targets = sweep_targets({program, program}, std::vector{part()}, {}, folder_.path());
  EXPECT_THROW(targets.front().run({Side::base, 0}), InputError);
}

TEST_F(TimedTargets, EachBenchmarkIsACaseInSeconds) {
  const auto program = benchmark("bench", R"json({"name": "insert/8", "real_time": 3, "time_unit": "ms"},
    {"name": "walk(1)", "run_name": "walk(1)", "run_type": "iteration", "real_time": 4, "time_unit": "us"},
    {"name": "walk(1)", "run_name": "walk(1)", "run_type": "iteration", "real_time": 6, "time_unit": "us"},
    {"name": "walk(1)_mean", "run_name": "walk(1)", "run_type": "aggregate", "real_time": 9, "time_unit": "us"})json");
  const TimedTarget target = benchmark_target({program, program}, {"--benchmark_min_time=1"}, {}, folder_.path());
  const auto seconds = target.run({Side::base, 0});
  ASSERT_EQ(seconds.size(), 2U);
  EXPECT_DOUBLE_EQ(seconds.at("insert/8"), 0.003);
  EXPECT_DOUBLE_EQ(seconds.at("walk(1)"), 5e-6);
  const std::string call = last_call();
  EXPECT_GT(call.find("--benchmark_min_time=1 "), call.find("--benchmark_min_time=0.05"))
      << "the user's option comes last";
  target.run({Side::head, 0, {"walk(1)"}});
  EXPECT_NE(last_call().find("--benchmark_filter=^(walk\\(1\\))$"), std::string::npos);
  EXPECT_NE(target.command(Side::head, "insert/8").find("insert/8"), std::string::npos);
}

TEST_F(TimedTargets, FailedAndMissingBenchmarksAreErrors) {
  for (const std::string runs : {"", R"({"name": "a", "error_occurred": true, "error_message": "no file"})"}) {
    const auto program = benchmark("bench", runs);
    EXPECT_THROW(benchmark_target({program, program}, {}, {}, folder_.path()).run({Side::base, 0}), ProgramFailed);
  }
  const auto nothing = script("nothing", "");
  EXPECT_THROW(benchmark_target({nothing, nothing}, {}, {}, folder_.path()).run({Side::base, 0}), Error);
}

TEST_F(TimedTargets, AnyProgramIsTimedAsAWhole) {
  const auto program = script("program", "sleep 0.02");
  const TimedTarget target = command_target({program, program}, {"a b", "c"}, {});
  const auto seconds = target.run({Side::head, 0});
  ASSERT_EQ(seconds.size(), 1U);
  EXPECT_GE(seconds.begin()->second, 0.02);
  EXPECT_NE(last_call().find("a b c"), std::string::npos);
  EXPECT_NE(target.command(Side::base, seconds.begin()->first).find("'a b' c"), std::string::npos);
}

}  // namespace
}  // namespace ccdt::gate
