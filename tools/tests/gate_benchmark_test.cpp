#include "tools/tests/gate_recordings.h"

namespace ccdt {
namespace {

/// Gates of a real program on Google Benchmark; see gated_benchmark.cpp.
class BenchmarkGate : public Gate {
 protected:
  BenchmarkGate() {
    std::filesystem::create_symlink(GATED_BENCHMARK, work() / "bench");
    // Wide limits, so that the load of this machine does not change the result.
    write(
        "rules.json",
        R"({"schema": "ccdt.rules/1", "time": {"relative": 0.3, "largest_noise": 0.5, "at_least": 5, "at_most": 20}})");
  }

  /// Runs a gate of a base and a head with these faults.
  Outcome gate(const std::string& base, const std::string& head, const std::string& layers = "exact,time") const {
    return run("gate --base 'env GATED=" + base + " ./bench' --head 'env GATED=" + head + " ./bench' --layers " +
               layers + " --rules rules.json -o out -- --benchmark_min_time=0.01");
  }

  Json of_case(const std::string& name, const std::string& figure) const {
    const Json all = verdict();
    for (const Json& one : all.at("figures"))
      if (one.at("case") == name && one.at("name") == figure) return one;
    return {};
  }
};

TEST_F(BenchmarkGate, TheSameProgramPassesWithItsCountersJudged) {
  EXPECT_EQ(gate("", "").exit_code, 0);
  EXPECT_EQ(of_case("BM_walk", "counters.steps").at("verdict"), "passed");
  EXPECT_TRUE(of_case("BM_walk", "counters.steps").at("gated"));
  EXPECT_FALSE(of_case("BM_walk", "counters.rate").at("gated"));
  EXPECT_FALSE(of_case("BM_walk", "counters.nothing").at("gated"));
  EXPECT_EQ(of_case("BM_sum", "real_time").at("verdict"), "passed");
  EXPECT_GT(of_case("BM_sum", "real_time").at("smallest_found"), 0.3);
}

TEST_F(BenchmarkGate, ACounterThatChangesIsWorse) {
  EXPECT_EQ(gate("", "count", "exact").exit_code, 1);
  EXPECT_EQ(of_case("BM_walk", "counters.steps").at("verdict"), "worse");
}

TEST_F(BenchmarkGate, ACrashIsOneRowAndTheOthersAreJudged) {
  const Outcome outcome = gate("", "crash");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(of_case("BM_sum", "status").at("verdict"), "worse");
  EXPECT_EQ(of_case("BM_walk", "real_time").at("verdict"), "passed");
  EXPECT_NE(outcome.out.find("SIGSEGV"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("Load Average"), std::string::npos) << outcome.out;
  EXPECT_EQ(gate("crash", "crash").exit_code, 3);
  EXPECT_EQ(of_case("BM_sum", "status").at("verdict"), "incomparable");
  EXPECT_EQ(gate("crash", "").exit_code, 3);
}

TEST_F(BenchmarkGate, OneMoreAllocationAndOneMoreSystemCallAreFound) {
  EXPECT_EQ(gate("", "allocate", "instructions").exit_code, 1);
  const Json allocations = of_case("BM_sum", "instructions.allocations");
  EXPECT_EQ(allocations.at("verdict"), "worse");
  EXPECT_EQ(allocations.at("head").get<int>(), allocations.at("base").get<int>() + 1);
  EXPECT_EQ(gate("", "call", "instructions").exit_code, 1);
  const Json calls = of_case("BM_sum", "instructions.system_calls");
  EXPECT_EQ(calls.at("verdict"), "worse");
  EXPECT_EQ(calls.at("head").get<int>(), calls.at("base").get<int>() + 1);
  EXPECT_EQ(of_case("BM_walk", "instructions.system_calls").at("verdict"), "passed");
  EXPECT_EQ(of_case("BM_walk", "instructions.total").at("ratio"), 1);
}

TEST_F(BenchmarkGate, MoreInstructionsNameTheFunctionThatGrew) {
  const Outcome outcome = gate("", "slow", "instructions");
  EXPECT_EQ(outcome.exit_code, 1);
  const Json total = of_case("BM_sum", "instructions.total");
  EXPECT_EQ(total.at("verdict"), "worse");
  EXPECT_NEAR(total.at("ratio").get<double>(), 2, 0.1);
  EXPECT_NE(total.at("words").get<std::string>().find("add_up"), std::string::npos) << total;
}

TEST_F(BenchmarkGate, WorkThatDependsOnTheEnvironmentIsUndecided) {
  EXPECT_EQ(gate("environment", "environment", "instructions").exit_code, 5);
  EXPECT_EQ(of_case("BM_sum", "instructions.total").at("verdict"), "undecided");
  EXPECT_EQ(of_case("BM_walk", "instructions.total").at("verdict"), "passed");
}

TEST_F(BenchmarkGate, ACommandIsCountedAsAWholeProcess) {
  EXPECT_EQ(
      run("gate --base 'cat rules.json' --head 'cat rules.json rules.json' --layers instructions -o out").exit_code, 1);
  EXPECT_EQ(verdict().at("figures").at(0).at("case"), "cat rules.json rules.json");
  EXPECT_EQ(run("gate --base 'cat rules.json' --head 'cat rules.json' --layers instructions -o out").exit_code, 0);
}

}  // namespace
}  // namespace ccdt
