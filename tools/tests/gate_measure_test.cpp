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

/// Programs that stand for those on Google Benchmark, with made-up times.
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
  static std::string benchmark_of(const std::string& milliseconds) {
    return "for a; do case $a in --benchmark_out=*) echo '{\"benchmarks\": [{\"name\": \"BM_x\", \"run_type\": "
           "\"iteration\", \"cpu_time\": 1, \"time_unit\": \"ms\", \"real_time\": '" +
           milliseconds + "'}]}' > \"${a#*=}\";; esac; done";
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

}  // namespace
}  // namespace ccdt
