#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "baselines/external_program.h"
#include "bench/gate/benchmark_target.h"
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

  bench::Case part() const {
    const auto input = folder_.path() / "part.off";
    std::ofstream(input) << "OFF";
    return {.name = "part", .group = "parts", .input = input, .options = {"--lattice", "bcc"}};
  }

  baselines::TemporaryFolder folder_;
};

constexpr const char* report = R"({"schema": "ccdt.run/1", "seconds": {"mesh": 0.5, "delaunay": 0.25}})";

TEST_F(TimedTargets, ACaseOfASweepIsTimedByItsReport) {
  const Programs programs = {{mesher("old", report)}, {mesher("new", report)}};
  Rules rules;
  rules.special.push_back({"other", rules.time});
  rules.special.back().time.figure = "seconds.delaunay";
  bench::Case other = part();
  other.name = "other";
  const auto targets = sweep_targets(programs, std::vector{part(), other}, rules, folder_.path());
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0].run({Side::base, 100}).at("part").seconds, 0.5);
  EXPECT_NE(last_call().find("/old mesh"), std::string::npos);
  EXPECT_NE(last_call().find("--lattice bcc"), std::string::npos);
  EXPECT_EQ(targets[1].run({Side::head, 0}).at("other").seconds, 0.25);
  EXPECT_NE(last_call().find("/new mesh"), std::string::npos);
  const std::string command = targets[1].command(Side::head, "other");
  EXPECT_NE(command.find(programs.head.front()), std::string::npos);
  EXPECT_NE(command.find((folder_.path() / "part.off").string()), std::string::npos);
}

TEST_F(TimedTargets, TheEnvironmentIsLargerByThePadding) {
  const auto program = mesher("same", report);
  const auto targets = sweep_targets({{program}, {program}}, std::vector{part()}, {}, folder_.path());
  for (const std::size_t padding : {0, 1234}) {
    targets.front().run({Side::base, padding});
    std::size_t seen = 1;
    std::ifstream(folder_.path() / "padding") >> seen;
    EXPECT_EQ(seen, padding);
  }
}

TEST_F(TimedTargets, AProgramThatFailsIsNamedWithItsSideAndWhatItPrinted) {
  const Programs programs = {{mesher("old", report)}, {mesher("new", report, "echo no memory for faces >&2\nexit 4")}};
  const auto targets = sweep_targets(programs, std::vector{part()}, {}, folder_.path());
  EXPECT_NO_THROW(targets.front().run({Side::base, 0}));
  try {
    targets.front().run({Side::head, 0});
    FAIL() << "the program exits with 4";
  } catch (const ProgramFailed& e) {
    EXPECT_EQ(e.side(), Side::head);
    EXPECT_EQ(e.place().file, programs.head.front());
    EXPECT_NE(std::string(e.what()).find("no memory for faces"), std::string::npos);
    EXPECT_NE(e.remedy().find("--lattice bcc"), std::string::npos);
  }
}

TEST_F(TimedTargets, AReportWithoutTheFigureIsAnError) {
  const auto program = mesher("same", R"({"schema": "ccdt.run/1", "seconds": {}})");
  const auto targets = sweep_targets({{program}, {program}}, std::vector{part()}, {}, folder_.path());
  EXPECT_THROW(targets.front().run({Side::base, 0}), InputError);
}

TEST_F(TimedTargets, EachBenchmarkIsACaseInSeconds) {
  const auto program = benchmark("bench", R"json({"name": "insert/8", "real_time": 3, "time_unit": "ms"},
    {"name": "walk(1)", "run_name": "walk(1)", "run_type": "iteration", "real_time": 4, "time_unit": "us"},
    {"name": "walk(1)", "run_name": "walk(1)", "run_type": "iteration", "real_time": 6, "time_unit": "us"},
    {"name": "walk(1)_mean", "run_name": "walk(1)", "run_type": "aggregate", "real_time": 9, "time_unit": "us"})json");
  const TimedTarget target =
      benchmark_target({{program}, {program}}, {"--benchmark_min_time=1"}, {}, {}, folder_.path());
  const auto seconds = target.run({Side::base, 0});
  ASSERT_EQ(seconds.size(), 2U);
  EXPECT_DOUBLE_EQ(seconds.at("insert/8").seconds, 0.003);
  EXPECT_DOUBLE_EQ(seconds.at("walk(1)").seconds, 5e-6);
  const std::string call = last_call();
  EXPECT_GT(call.find("--benchmark_min_time=1 "), call.find("--benchmark_min_time=0.05"))
      << "the user's option comes last";
  target.run({Side::head, 0, {"walk(1)"}});
  EXPECT_NE(last_call().find("--benchmark_filter=^(walk\\(1\\))$"), std::string::npos);
  EXPECT_NE(target.command(Side::head, "insert/8").find("insert/8"), std::string::npos);
}

TEST_F(TimedTargets, RepetitionsAreMeasuredWithoutTheirMedian) {
  const auto program = benchmark("bench", R"json({"name": "walk", "run_name": "walk", "run_type": "iteration",
    "real_time": 4}, {"name": "walk", "run_name": "walk", "run_type": "iteration", "real_time": 6},
    {"name": "walk_median", "run_name": "walk", "run_type": "aggregate", "aggregate_name": "median",
     "real_time": 90})json");
  const Measured found = benchmark_target({{program}, {program}}, {}, {}, {}, folder_.path()).run({Side::base, 0});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found.at("walk").seconds, 5e-9);
}

TEST_F(TimedTargets, AFailedBenchmarkIsACaseAndAProgramWithoutAnyAnError) {
  const auto failing = benchmark("failing", R"({"name": "a", "error_occurred": true, "error_message": "no file"},
    {"name": "b", "real_time": 1, "time_unit": "s"})");
  const Measured both = benchmark_target({{failing}, {failing}}, {}, {}, {}, folder_.path()).run({Side::base, 0});
  EXPECT_NE(both.at("a").failure.find("no file"), std::string::npos);
  EXPECT_EQ(both.at("b").failure, "");
  for (const auto& program : {benchmark("empty", ""), script("nothing", "")})
    EXPECT_THROW(benchmark_target({{program}, {program}}, {}, {}, {}, folder_.path()).run({Side::base, 0}),
                 ProgramFailed);
}

TEST_F(TimedTargets, CountersAndTheTimeOfAllIterationsAreMeasured) {
  const auto program = benchmark("bench", R"({"name": "a", "real_time": 2, "cpu_time": 1, "time_unit": "us",
    "iterations": 1000, "cells": 7, "rate": NaN, "items_per_second": 5})");
  const Measured found = benchmark_target({{program}, {program}}, {}, {}, {}, folder_.path()).run({Side::base, 0});
  EXPECT_DOUBLE_EQ(found.at("a").timed_seconds, 0.002);
  EXPECT_EQ(found.at("a").counters.at("cells"), 7);
  EXPECT_TRUE(std::isnan(found.at("a").counters.at("rate")));
  EXPECT_FALSE(found.at("a").counters.contains("items_per_second"));
  Rules rules;
  rules.time.figure = "cpu_time";
  EXPECT_DOUBLE_EQ(
      benchmark_target({{program}, {program}}, {}, rules, {}, folder_.path()).run({Side::base, 0}).at("a").seconds,
      1e-6);
}

TEST_F(TimedTargets, TheReasonOfAFailureHasNoBanner) {
  const auto program = script("crash",
                              "printf '2026-01-02T03:04:05+00:00\\nRunning ./x\\nRun on (2 X 2000 MHz CPU s)\\n"
                              "Load Average: 1.0\\n***WARNING*** scaling\\nno memory left\\n' >&2; kill -SEGV $$\n");
  try {
    run({Side::head, 0}, {program.string()}, {});
    FAIL() << "it crashes";
  } catch (const ProgramFailed& failure) {
    const std::string what = failure.what();
    EXPECT_NE(what.find("SIGSEGV"), std::string::npos) << what;
    EXPECT_NE(what.find("no memory left"), std::string::npos) << what;
    for (const char* banner : {"Running", "Run on", "Load Average", "WARNING", "2026"})
      EXPECT_EQ(what.find(banner), std::string::npos) << what;
  }
}

TEST_F(TimedTargets, ACommandIsSplitAsAShellDoes) {
  const auto program = script("a tool", "").string();
  EXPECT_EQ(command_from(program, "--base"), Command{program});
  EXPECT_EQ(command_from("'" + program + "' 'x y' z", "--base"), (Command{program, "x y", "z"}));
  EXPECT_EQ(command_from("true", "--base").front().substr(0, 1), "/");
  EXPECT_EQ(command_from("true | false", "--base"), (Command{"/bin/sh", "-c", "true | false"}));
  EXPECT_EQ(short_name({"/some/where/tool", "in put"}), "tool 'in put'");
  for (const char* wrong : {"no-such-program 1", "", "./not-here"})
    EXPECT_THROW(command_from(wrong, "--base"), InputError) << wrong;
}

TEST_F(TimedTargets, AnyProgramIsTimedAsAWhole) {
  const auto program = script("program", "sleep 0.02");
  const TimedTarget target = command_target({{program}, {program}}, {"a b", "c"}, {});
  const auto seconds = target.run({Side::head, 0});
  ASSERT_EQ(seconds.size(), 1U);
  EXPECT_GE(seconds.begin()->second.seconds, 0.02);
  EXPECT_NE(last_call().find("a b c"), std::string::npos);
  EXPECT_NE(target.command(Side::base, seconds.begin()->first).find("'a b' c"), std::string::npos);
}

}  // namespace
}  // namespace ccdt::gate
