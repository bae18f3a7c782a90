#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr int program_missing = 3;

/// Sweeps on a Slurm cluster of two nodes on this machine, which ends with the test in any case.
class SlurmSweep : public Program {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "Slurm starts programs with random addresses, which the sanitizers of GCC 12 cannot cope with";
#endif
    const int code = loopback("start", std::to_string(getpid()));
    if (code == program_missing) GTEST_SKIP() << "Slurm is not installed here; tools/setup test installs it";
    ASSERT_EQ(code, 0) << text_of(work() / "loopback.log");
    setenv("SLURM_CONF", (cluster() / "slurm.conf").c_str(), 1);
  }
  void TearDown() override {
    unsetenv("SLURM_CONF");
    loopback("stop");
  }

  std::filesystem::path cluster() const {
    return work() / "cluster";
  }

  int loopback(const std::string& verb, const std::string& more = "") const {
    return shell("CPUS=2 MEMORY=8000 " CCDT_SOURCE_DIR "/tools/slurm-loopback " + verb + " '" + cluster().string() +
                 "' " + more + " >>'" + (work() / "loopback.log").string() + "' 2>&1");
  }

  static int shell(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Json status() const {
    const Outcome outcome = run("sweep spec.json -o out --status --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }

  void submit() const {
    const Outcome outcome = run("sweep spec.json -o out --slurm --chunk-minutes 0.003");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  std::vector<Json> records() const {
    std::vector<Json> all;
    if (!std::filesystem::exists(work() / "out" / "runs")) return all;
    for (const auto& entry : std::filesystem::directory_iterator(work() / "out" / "runs"))
      if (entry.path().extension() == ".json") all.push_back(Json::parse(text_of(entry.path()), nullptr, false));
    return all;
  }

  /// The number of tasks ever started, by their logs.
  std::size_t task_count() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(work() / "out" / "slurm"))
      count += entry.path().extension() == ".log" ? 1 : 0;
    return count;
  }

  template <class Condition>
  static bool wait_for(double seconds, Condition condition) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return true;
  }

  int chunks(const char* where) const {
    return status().at("chunks").value(where, -1);
  }

  /// The number of chunks that run or wait, from one status: a chunk may start between two of them.
  int chunks_underway() const {
    const Json counts = status().at("chunks");
    return counts.value("running", -1) + counts.value("queued", -1);
  }
};

TEST_F(SlurmSweep, AccountsForEveryCaseThoughANodeDiesAndACaseRunsOutOfMemory) {
  ASSERT_EQ(run("model cube --edge-length 0.25 -o cube.off").exit_code, 0);
  write("eats.json", Json{{"schema", "ccdt.mesher/1"},
                          {"name", "eats"},
                          {"what", "allocates without bound"},
                          {"licence", "none"},
                          {"command", {MISBEHAVING_CHILD, "eat-memory"}},
                          {"input_format", "poly"},
                          {"output", "out.mesh"}}
                         .dump());
  const Json spec = {
      {"schema", "ccdt.sweep/1"},
      {"name", "cluster"},
      {"inputs", {{{"model", "cube"}, {"edge_length", {0.5, 0.34, 0.25, 0.2, 0.17, 0.15}}}, {{"files", "cube.off"}}}},
      {"meshers", {"ccdt", "eats.json"}},
      {"exclude",
       {{{"mesher", "eats"}, {"model", "cube"}},
        {{"mesher", "eats"}, {"lattice", {"bcc", "sc"}}},
        {{"mesher", "eats"}, {"locator", {"octree", "grid"}}},
        {{"mesher", "eats"}, {"face-protection", "off"}},
        {{"mesher", "eats"}, {"protection", "midpoint"}}}},
      {"options",
       {{"lattice", {"fcc", "bcc", "sc"}},
        {"locator", {"cavity", "octree", "grid"}},
        {"face-protection", {"on", "off"}},
        {"protection", {"shell", "midpoint"}},
        {"improve", "none"}}},
      {"limits", {{"seconds", 30}, {"bytes", 300'000'000}}}};
  write("spec.json", spec.dump());
  submit();
  const int cases = status().at("cases");
  EXPECT_GE(cases, 200);

  // In the middle of the sweep a node dies with all that runs on it.
  const auto is_busy = [] { return shell("squeue --noheader --nodelist=n2 --states=RUNNING | grep -q .") == 0; };
  ASSERT_TRUE(wait_for(60, [&] { return records().size() > 40 && is_busy(); }));
  ASSERT_EQ(loopback("kill-node", "n2"), 0);
  ASSERT_LT(records().size(), static_cast<std::size_t>(cases));

  // Slurm restarts the tasks elsewhere or gives them up; queued tasks are not submitted again.
  EXPECT_TRUE(wait_for(75, [&] {
    submit();
    return status().at("missing") == 0;
  })) << status().dump();
  std::map<std::string, int> kinds;
  std::set<std::string> ids;
  for (const Json& record : records()) {
    ++kinds[record.at("status") == "ok" ? "ok" : record.value("kind", "none")];
    ids.insert(record.at("case"));
  }
  EXPECT_EQ(static_cast<int>(ids.size()), cases);
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"ok", cases - 1}, {"out_of_memory", 1}}));
}

TEST_F(SlurmSweep, SubmitsNothingTwiceAndWhatWasCanceledAgain) {
  write("sleeps.json", Json{{"schema", "ccdt.mesher/1"},
                            {"name", "sleeps"},
                            {"what", "takes its time"},
                            {"licence", "none"},
                            {"command", {"sleep", "600"}},
                            {"input_format", "poly"},
                            {"output", "out.mesh"}}
                           .dump());
  write("spec.json", Json{{"schema", "ccdt.sweep/1"},
                          {"inputs", {{{"model", "cube"}, {"edge_length", {0.5, 0.25, 1}}}}},
                          {"meshers", {"sleeps.json"}},
                          {"limits", {{"seconds", 600}, {"bytes", 300'000'000}}}}
                         .dump());
  submit();
  ASSERT_TRUE(wait_for(30, [&] { return chunks("running") > 0; }));
  const int all = chunks_underway();
  submit();
  EXPECT_EQ(chunks_underway(), all) << status().dump();
  EXPECT_EQ(chunks("missing"), 0);
  ASSERT_EQ(shell("scancel --user=$(id -un)"), 0);
  ASSERT_TRUE(wait_for(30, [&] { return chunks("missing") == all; }));
  submit();
  EXPECT_EQ(chunks_underway(), all) << status().dump();
}

}  // namespace
}  // namespace ccdt
