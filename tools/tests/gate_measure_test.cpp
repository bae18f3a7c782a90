#include <cstdlib>
#include <map>

#include "tools/tests/gate_recordings.h"

namespace ccdt {
namespace {

class MeasuringGate : public Gate {
 protected:
  MeasuringGate() {
    write("cases.json", R"({"schema": "ccdt.sweep/1", "inputs": [{"model": "bracket", "edge_length": 10}],
                            "options": {"lattice": ["none", "bcc"], "improve": ["none"]}})");
    std::filesystem::create_symlink(CCDT_PROGRAM, work() / "ccdt");
    // A program that meshes worse than requested.
    write("worse",
          "#!/bin/sh\nfor word; do shift; [ \"$word\" = bcc ] && word=sc; set -- \"$@\" \"$word\"; done\n"
          "exec '" +
              std::string(CCDT_PROGRAM) + "' \"$@\"\n");
    std::filesystem::permissions(work() / "worse", std::filesystem::perms::owner_all);
  }
};

TEST_F(MeasuringGate, AProgramPassesAgainstItself) {
  EXPECT_EQ(run("gate --base ccdt --head ccdt --sweep cases.json --layers exact -o out").exit_code, 0);
  EXPECT_GT(verdict().at("counts").at("passed"), 20);
}

TEST_F(MeasuringGate, AnotherProgramFailsWhereItDiffers) {
  EXPECT_EQ(run("gate --base ccdt --head worse --sweep cases.json --layers exact -o out").exit_code, 1);
  int others = 0;  // cases without the lattice are the same
  const Json found = verdict();
  for (const Json& one : found.at("figures")) {
    const bool is_other = one.at("case").get<std::string>().find("bcc") == std::string::npos;
    others += one.at("verdict") == "worse" && is_other ? 1 : 0;
  }
  EXPECT_EQ(others, 0);
  EXPECT_EQ(run("gate --base ccdt --head ccdt --sweep cases.json --layers exact -o out").exit_code, 0);
}

TEST_F(MeasuringGate, AProgramIsMeasuredAnewEvenIfItsFileIsTheSame) {
  const std::string call = "gate --base ccdt --head script --sweep cases.json --layers exact -o out";
  write("script", "#!/bin/sh\nexec '" + (work() / "called").string() + "' \"$@\"\n");
  std::filesystem::permissions(work() / "script", std::filesystem::perms::owner_all);
  std::filesystem::create_symlink(CCDT_PROGRAM, work() / "called");
  EXPECT_EQ(run(call).exit_code, 0);
  std::filesystem::rename(work() / "worse", work() / "called");
  EXPECT_EQ(run(call).exit_code, 1);
}

TEST_F(MeasuringGate, ABaselineIsMadeOfAMeasuredProgramAndGatesOthers) {
  const std::string options = " --sweep cases.json --layers exact -o out --against baseline.json";
  ASSERT_EQ(run("gate --head ccdt --update --reason first" + options).exit_code, 0);
  EXPECT_EQ(run("gate --head ccdt" + options).exit_code, 0);
  EXPECT_EQ(run("gate --head worse" + options).exit_code, 1);
}

TEST_F(MeasuringGate, AnErrorIsNoVerdict) {
  // Nothing can be counted, and so nothing was judged.
  const auto broken = work() / "broken";
  std::filesystem::create_directory(broken);
  write("broken/valgrind", "#!/bin/sh\nexit 1\n");
  std::filesystem::permissions(broken / "valgrind", std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (broken.string() + ":" + path).c_str(), 1);
  const Outcome outcome = run("gate --base ccdt --head ccdt --sweep cases.json --layers instructions -o out");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_FALSE(outcome.err.empty());
  EXPECT_FALSE(std::filesystem::exists(work() / "out/verdict.json"));
}

/// Programs that imitate ones with Google Benchmark, with made-up times.
class TimedGate : public Gate {
 protected:
  TimedGate() {
    write_program("quick", benchmark_of("1000"));
    write_program("slow", benchmark_of("1100"));
    // A generator with a state in a file, so that each run of the test sees the same noise.
    write("state", "1");
    write_program("noisy",
                  "state=${0%/*}/state; n=$((($(cat \"$state\") * 1103515245 + 12345) % 2147483648))\n"
                  "echo $n > \"$state\"\n" +
                      benchmark_of("$((500 + n / 65536 % 2000))"));
    write_program("failing", "exit 4");
    write("rules.json", R"({"schema": "ccdt.rules/1", "time": {"at_least": 8, "at_most": 16}})");
  }

  /// A shell script that reports a benchmark of this many milliseconds.
  static std::string benchmark_of(const std::string& milliseconds) { return benchmarks_of({{"BM_x", milliseconds}}); }

  /// The same with several benchmarks.
  static std::string benchmarks_of(const std::map<std::string, std::string>& milliseconds) {
    std::string runs;
    for (const auto& [name, time] : milliseconds)
      runs += (runs.empty() ? "" : ",") + std::string("{\"name\": \"") + name +
              "\", \"run_type\": \"iteration\", \"iterations\": 1000000, \"cpu_time\": 1, \"time_unit\": \"ms\", "
              "\"real_time\": '" +
              time + "'}";
    return "for a; do case $a in --benchmark_out=*) echo '{\"benchmarks\": [" + runs + "]}' > \"${a#*=}\";; esac; done";
  }

  void write_program(const std::string& name, const std::string& what) const {
    write(name, "#!/bin/sh\n" + what + "\n");
    std::filesystem::permissions(work() / name, std::filesystem::perms::owner_all);
  }

  int gate(const std::string& base, const std::string& head) const {
    const std::string programs = "--base " + base + " --head " + head;
    return run("gate " + programs + " --rules rules.json --seed 1 -o out -- --benchmark_filter=.").exit_code;
  }
};

TEST_F(TimedGate, ASlowerProgramFails) {
  EXPECT_EQ(gate("quick", "slow"), 1);
  const Json time = verdict().at("figures").at(0);
  EXPECT_EQ(time.at("layer"), "time");
  EXPECT_EQ(time.at("case"), "BM_x");
  EXPECT_NEAR(time.at("interval").at(0), 1.1, 1e-6);
  EXPECT_NE(time.at("command").get<std::string>().find("slow"), std::string::npos);
  EXPECT_FALSE(verdict().at("correction").get<std::string>().empty());
}

TEST_F(TimedGate, ATooNoisyProgramIsUndecided) {
  EXPECT_EQ(gate("noisy", "noisy"), 5);
  EXPECT_EQ(verdict().at("figures").at(0).at("verdict"), "undecided");
}

TEST_F(TimedGate, AFasterProgramPassesAndIsReported) {
  EXPECT_EQ(gate("slow", "quick"), 0);
  EXPECT_TRUE(verdict().at("figures").at(0).at("changed"));
}

TEST_F(TimedGate, AProgramThatFailsIsWorseUnlessItIsTheBase) {
  EXPECT_EQ(gate("quick", "failing"), 1);
  EXPECT_EQ(gate("failing", "quick"), 3);
  for (int seed = 1; seed <= 4; ++seed) {
    const Outcome both =
        run("gate --base failing --head failing -o out --seed " + std::to_string(seed) + " -- --benchmark_filter=.");
    EXPECT_EQ(both.exit_code, 3) << "seed " << seed;
    EXPECT_NE(both.out.find("exit code 4"), std::string::npos) << both.out;
  }
}

TEST_F(TimedGate, ACalibrationSaysHowManyPairsItNeeds) {
  const std::string options = "gate --base slow --calibrate --rules rules.json -o out ";
  const Outcome few = run(options + "--pairs 5 -- --benchmark_filter=.");
  EXPECT_EQ(few.exit_code, 3);
  EXPECT_NE(few.err.find("--pairs "), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(work() / "out/calibration.json"));
  EXPECT_EQ(run(options + "--pairs 20 -- --benchmark_filter=.").exit_code, 0);
  EXPECT_EQ(Json::parse(text_of(work() / "out/calibration.json")).at("schema"), "ccdt.calibration/1");
}

TEST_F(TimedGate, ACalibrationOfAProgramThatFailsIsAnError) {
  const Outcome outcome = run("gate --base failing --calibrate -o out -- --benchmark_filter=.");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("exit code 4"), std::string::npos) << outcome.err;
}

TEST_F(TimedGate, TenTimesSlowerNeverPassesHoweverShortAnIteration) {
  for (const std::string milliseconds : {"0.000001", "0.00469", "0.21", "20", "10000"}) {
    write_program("base", benchmark_of(milliseconds));
    write_program("head", benchmark_of(milliseconds + "0"));
    if (milliseconds.find('.') != std::string::npos)
      write_program("head", benchmark_of(std::to_string(std::stod(milliseconds) * 10)));
    EXPECT_EQ(gate("base", "head"), 1) << milliseconds << " ms";
  }
  write_program("base", benchmark_of("0.21"));
  write_program("head", benchmark_of("0.2625"));
  EXPECT_EQ(gate("base", "head"), 1);
}

TEST_F(TimedGate, LostAndNewBenchmarksAreNamed) {
  write_program("base", benchmarks_of({{"BM_same", "10"}, {"BM_old", "10"}}));
  write_program("head", benchmarks_of({{"BM_same", "10"}, {"BM_new", "10"}}));
  EXPECT_EQ(gate("base", "head"), 1);
  EXPECT_EQ(verdict().at("figures").at(0).at("case"), "BM_old");
  const Outcome outcome = run("gate --base base --head head -o out -- --benchmark_filter=.");
  for (const char* name : {"BM_same", "BM_old", "BM_new"}) EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
  write("rules.json", R"({"schema": "ccdt.rules/1", "may_be_missing": ["BM_old"]})");
  EXPECT_EQ(gate("base", "head"), 0);
  EXPECT_EQ(gate("head", "head"), 0);
  write_program("renamed", benchmarks_of({{"BM_other", "10"}}));
  EXPECT_EQ(gate("head", "renamed"), 1);
}

TEST_F(TimedGate, TheHeadThatHangsIsWorse) {
  write_program("hangs", "sleep 1000");
  const Outcome outcome = run("gate --base quick --head hangs --time-limit 1 -o out -- --benchmark_filter=.");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("limit of 1 s"), std::string::npos) << outcome.out;
}

TEST_F(TimedGate, CommandsAreRunInTurns) {
  write_program("tool", "read x < \"$1\"; sleep $x");
  write("short", "0.01\n");
  write("long", "0.1\n");
  write("rules.json", R"({"schema": "ccdt.rules/1", "time": {"at_least": 6, "at_most": 12}})");
  const std::string options = " --rules rules.json --seed 1 -o out";
  EXPECT_EQ(run("gate --base './tool short' --head './tool long'" + options).exit_code, 1);
  EXPECT_EQ(verdict().at("figures").at(0).at("name"), "wall");
  EXPECT_EQ(run("gate --base 'cat short | ./tool short' --head './tool long'" + options).exit_code, 1);
  EXPECT_EQ(run("gate --base './no-such-tool' --head './tool long'" + options).exit_code, 3);
  EXPECT_EQ(run("gate --base ./tool --head ./tool" + options + " --layers exact -- short").exit_code, 3)
      << "there is nothing exact about it";
}

TEST_F(TimedGate, ProgramsAreRebuiltWithSeedsOfTheirOwn) {
  // The command copies the program and notes what it was asked.
  write_program("again",
                "echo \"$CCDT_GATE_SIDE $CCDT_GATE_SEED\" >> builds; cp \"$CCDT_GATE_PROGRAM\" \"$CCDT_GATE_OUTPUT\"");
  const std::string call = "gate --base quick --head slow --seed 1 -o out --rebuild ./again --layouts 4 ";
  EXPECT_EQ(run(call + "--rules rules.json -- --benchmark_filter=.").exit_code, 1);
  const std::string builds = text_of(work() / "builds");
  for (const char* build : {"base 1\n", "head 1\n", "base 4\n", "head 4\n"})
    EXPECT_NE(builds.find(build), std::string::npos) << build;
  EXPECT_EQ(builds.find("base 1\n"), builds.rfind("base 1\n")) << "each is built once";
  const Json samples = Json::parse(text_of(work() / "out/samples.json"));
  EXPECT_TRUE(samples.at("rebuilt"));
  EXPECT_EQ(run("gate --base quick --head slow -o out --rebuild 'exit 3' -- --benchmark_filter=.").exit_code, 3);
  EXPECT_EQ(run("gate --base quick --head slow -o out --rebuild true -- --benchmark_filter=.").exit_code, 3);
}

TEST_F(TimedGate, AStoppedGateKeepsItsTimesAndSaysHowToGoOn) {
  write_program("sleeper", "sleep 0.05\n" + benchmark_of("10"));
  const std::string call = " gate --base sleeper --head sleeper -o out";
  const std::string program = "'" + std::string(CCDT_PROGRAM) + "'";
  const std::string stopped = "timeout --signal=INT 1 " + program + call + " -- --benchmark_filter=. 2> err";
  const int status = std::system(("cd '" + work().string() + "' && " + stopped).c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_NE(text_of(work() / "err").find("--resume"), std::string::npos);
  const Json kept = Json::parse(text_of(work() / "out/samples.json"));
  const std::size_t pairs = kept.at("cases").at(0).at("screening").size();
  EXPECT_GT(pairs, 0u);
  EXPECT_FALSE(kept.at("finished"));
  EXPECT_EQ(run("gate --base sleeper --head sleeper -o out --resume -- --benchmark_filter=.").exit_code, 0);
  const Json after = Json::parse(text_of(work() / "out/samples.json"));
  EXPECT_TRUE(after.at("finished"));
  EXPECT_EQ(after.at("seed"), kept.at("seed"));
  EXPECT_EQ(after.at("cases").at(0).at("screening").at(0), kept.at("cases").at(0).at("screening").at(0));
  for (const char* other : {"--base quick --head sleeper", "--base sleeper --head quick"})
    EXPECT_EQ(run("gate " + std::string(other) + " -o out --resume -- --benchmark_filter=.").exit_code, 3)
        << "those are the times of other programs";
}

}  // namespace
}  // namespace ccdt
