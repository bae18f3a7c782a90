#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "engine/tests/shared/real_parts.h"
#include "tools/tests/program.h"

/// Sweeps that are killed, and meshers that misbehave. With arguments, the program does more than a quick test:
///
///     sweep_chaos_test large 10 1     models, real parts and all strategies; ten kills; seed of their moments

namespace ccdt {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

struct Chaos {
  bool is_large = false;
  int kills = 4;
  unsigned seed = 1;
};
Chaos chaos;  // from the command line

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The parts that must be equal in two records of one run: everything except times, memory and the state of the
/// machine.
Json deterministic(Json record) {
  for (const char* name : {"seconds", "cpu_seconds", "peak_rss_bytes", "environment", "reason"}) record.erase(name);
  if (record.contains("verification")) record["verification"].erase("seconds");
  return record;
}

/// The state of a file. If it changes, the file was written again.
struct FileState {
  ino_t inode = 0;
  std::int64_t changed = 0;
  friend bool operator==(const FileState&, const FileState&) = default;
};

class Sweep : public Program {
 protected:
  using Files = std::map<std::string, FileState>;

  /// The records of a sweep.
  Files records(const std::string& folder) const {
    Files files;
    const auto runs = work() / folder / "runs";
    if (!std::filesystem::exists(runs)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(runs)) {
      struct stat found = {};
      if (entry.path().extension() != ".json" || stat(entry.path().c_str(), &found) != 0) continue;
      files[entry.path().filename()] = {found.st_ino, found.st_mtim.tv_sec * 1'000'000'000LL + found.st_mtim.tv_nsec};
    }
    return files;
  }

  /// Waits until a sweep has this many records, or this time has passed.
  void wait_for_records(const std::string& folder, std::size_t count, double seconds) const {
    const auto begin = Clock::now();
    while (seconds_since(begin) < seconds && records(folder).size() < count)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  Json record(const std::string& folder, const std::string& name) const {
    return Json::parse(text_of(work() / folder / "runs" / name), nullptr, false);
  }

  /// The program in a separate process, without output.
  pid_t start(std::vector<std::string> words) const {
    words.insert(words.begin(), CCDT_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_RDWR);
      for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
      if (chdir(work().c_str()) == 0) execv(arguments.front(), arguments.data());
      _exit(127);
    }
    return child;
  }

  /// A described mesher that needs nothing but this program.
  void describe(const std::string& name, const std::vector<std::string>& command) const {
    write(name + ".json", Json{{"schema", "ccdt.mesher/1"},
                               {"name", name},
                               {"what", "a mesher of a test"},
                               {"licence", "none"},
                               {"command", command},
                               {"input_format", "poly"},
                               {"output", "out.mesh"}}
                              .dump());
  }

  void write_quick_spec() const {
    ASSERT_EQ(run("model cube --edge-length 0.5 -o cube.off").exit_code, 0);
    describe("other", {CCDT_PROGRAM, "mesh", "{input}", "-o", "out.mesh", "--lattice", "none", "--improve", "none"});
    const Json spec = {{"schema", "ccdt.sweep/1"},
                       {"name", "chaos"},
                       {"inputs", {{{"model", "sphere"}, {"edge_length", 0.5}}, {{"files", "cube.off"}}}},
                       {"meshers", {"ccdt", "tetgen", "other.json"}},
                       {"options",
                        {{"lattice", {"fcc", "bcc"}},
                         {"locator", {"cavity", "octree", "grid"}},
                         {"face-protection", {"on", "off"}},
                         {"improve", {"none"}}}},
                       {"repetitions", 2},
                       {"warm_up", 0},
                       {"verify", true},
                       {"limits", {{"seconds", 60}, {"bytes", 2'000'000'000}}}};
    write("spec.json", spec.dump());
  }

  void write_large_spec() const {
    describe("other", {CCDT_PROGRAM, "mesh", "{input}", "-o", "out.mesh", "--lattice", "none", "--improve", "none"});
    Json inputs = {
        {{"model", "piston"}, {"edge_length", {{"from", 16}, {"to", 12}, {"steps", 2}, {"scale", "log"}}}},
        {{"model", "bracket"}, {"edge_length", 16}},
        {{"model", "sphere"}, {"edge_length", 0.3}, {"options", {{"improve", {"all", "swap", "smooth", "none"}}}}}};
    for (const char* part : {"joint.off", "anchor.off"})
      if (std::filesystem::exists(folder_of_parts() / part)) inputs.push_back({{"files", folder_of_parts() / part}});
    const Json spec = {{"schema", "ccdt.sweep/1"},
                       {"name", "chaos"},
                       {"inputs", inputs},
                       {"meshers", {"ccdt", "tetgen", "other.json"}},
                       {"options",
                        {{"lattice", {"fcc", "bcc", "sc", "none"}},
                         {"locator", {"cavity", "octree", "grid"}},
                         {"face-protection", {"on", "off"}},
                         {"delaunay", {"insert", "wrap"}},
                         {"protection", {"shell", "midpoint"}},
                         {"improve", {"none"}}}},
                       {"repetitions", 1},
                       {"verify", true},
                       {"limits", {{"seconds", 60}, {"bytes", 2'000'000'000}}}};
    write("spec.json", spec.dump());
  }

  /// Finished records still exist and were not written again.
  static void expect_kept(const Files& before, const Files& after) {
    for (const auto& [name, state] : before) {
      ASSERT_TRUE(after.contains(name)) << name << " is lost";
      EXPECT_EQ(after.at(name), state) << name << " was run again";
    }
  }

  void expect_whole(const std::string& folder, const Files& files) const {
    for (const auto& [name, state] : files) EXPECT_EQ(record(folder, name).value("schema", ""), "ccdt.run/1") << name;
  }

  /// No killed process is left.
  int processes_here() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
      if (text_of(entry.path() / "cmdline").find(work().string()) != std::string::npos) ++count;
    return count;
  }
};

TEST_F(Sweep, ThatIsKilledAgainAndAgainEndsLikeAnUndisturbedOne) {
  if (chaos.is_large)
    write_large_spec();
  else
    write_quick_spec();
  const auto begin = Clock::now();
  const Outcome whole = run("sweep spec.json -o whole");
  const double undisturbed = seconds_since(begin);
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  const Files expected = records("whole");
  ASSERT_GT(expected.size(), chaos.is_large ? 300u : 30u);

  std::mt19937 random(chaos.seed);
  // Together about half of the sweep's time.
  std::uniform_real_distribution<double> moment(0, undisturbed / chaos.kills);
  Files before;
  for (int kill_number = 0; kill_number < chaos.kills; ++kill_number) {
    const pid_t sweep = start({"sweep", "spec.json", "-o", "killed"});
    // The sweep may be faster now than when it was timed, but must not be finished before the last kill.
    wait_for_records("killed", expected.size() * (kill_number + 1) / (chaos.kills + 1), moment(random));
    ASSERT_EQ(kill(sweep, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(waitpid(sweep, &status, 0), sweep);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the sweep ended before it was killed";
    const Files after = records("killed");
    std::printf("killed with %zu of %zu runs\n", after.size(), expected.size());
    expect_kept(before, after);
    expect_whole("killed", after);
    before = after;
  }
  EXPECT_FALSE(before.empty());
  ASSERT_LT(before.size(), expected.size());

  const Outcome last = run("sweep spec.json -o killed");
  EXPECT_EQ(last.exit_code, 0) << last.err;
  const Files after = records("killed");
  expect_kept(before, after);
  ASSERT_EQ(after.size(), expected.size());
  for (const auto& [name, state] : expected) {
    ASSERT_TRUE(after.contains(name)) << name;
    EXPECT_EQ(deterministic(record("killed", name)), deterministic(record("whole", name))) << name;
  }
  for (const auto& entry : std::filesystem::directory_iterator(work() / "killed" / "runs"))
    EXPECT_EQ(entry.path().extension(), ".json") << entry.path() << " is left of a kill";
  EXPECT_EQ(processes_here(), 0);
  std::printf("%zu runs, %.1f s undisturbed, %d kills\n", expected.size(), undisturbed, chaos.kills);
}

TEST_F(Sweep, OfMeshersThatMisbehaveHasOneRowOfTheRightKindForEach) {
  ASSERT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  const std::map<std::string, std::string> kinds = {{"segfaults", "crashed"},         {"hangs", "timeout"},
                                                    {"eats-memory", "out_of_memory"}, {"fills-disk", "limit"},
                                                    {"half-a-mesh", "wrong"},         {"says-no", "refused"}};
  describe("segfaults", {"sh", "-c", "kill -SEGV $$"});
  describe("hangs", {"sleep", "600"});
  describe("eats-memory", {MISBEHAVING_CHILD, "eat-memory"});
  describe("fills-disk", {"sh", "-c", "exec cat /dev/zero >out.mesh"});
  describe("half-a-mesh",
           {"sh", "-c",
            "'" CCDT_PROGRAM "' mesh {input} -o all.mesh && head -c $(($(wc -c <all.mesh) / 2)) all.mesh >out.mesh"});
  describe("says-no", {"sh", "-c", "echo no >&2; exit 1"});
  Json meshers = {"ccdt"};
  for (const auto& [mesher, kind] : kinds) meshers.push_back(mesher + ".json");
  const Json spec = {{"schema", "ccdt.sweep/1"},
                     {"name", "misbehaving"},
                     {"inputs", {{{"files", "cube.off"}}}},
                     {"meshers", meshers},
                     {"repetitions", 3},
                     {"warm_up", 0},
                     {"verify", true},
                     {"limits", {{"seconds", 8}, {"bytes", 500'000'000}, {"disk_bytes", 50'000'000}}}};
  write("spec.json", spec.dump());
  const Outcome outcome = run("sweep spec.json -o out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, int> rows;
  for (const auto& [name, state] : records("out")) {
    const Json one = record("out", name);
    const std::string mesher = one.at("mesher").at("name");
    ++rows[mesher];
    const std::string kind = mesher == "ccdt" ? "none" : kinds.at(mesher);
    EXPECT_EQ(one.value("kind", "none"), kind) << mesher << ": " << one.value("reason", "");
  }
  EXPECT_EQ(rows["ccdt"], 3);
  for (const auto& [mesher, kind] : kinds) EXPECT_EQ(rows[mesher], 1) << mesher;
  EXPECT_EQ(processes_here(), 0);
}

}  // namespace
}  // namespace ccdt

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) ccdt::chaos.is_large = std::string(argv[1]) == "large";
  if (argc > 2) ccdt::chaos.kills = std::stoi(argv[2]);
  if (argc > 3) ccdt::chaos.seed = static_cast<unsigned>(std::stoul(argv[3]));
  return RUN_ALL_TESTS();
}
