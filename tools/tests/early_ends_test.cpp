#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// A call of the program.
struct Call {
  std::vector<std::string> words;
  std::vector<std::string> results = {};  ///< files; if any is there, so is the last one
  std::string record = {};                ///< a report that says from the beginning how the call ended
  std::string folder = {};                ///< of whole parts of the result, with which the next call continues
  std::set<int> ends = {0};               ///< exit codes, undisturbed
};

/// A limit of the system for one call.
struct SystemLimit {
  int resource = 0;
  rlim_t bytes = 0;
};

/// Ends that come from outside: signals, limits of memory, a full disk. What a call wrote for itself goes with it.
class EarlyEnd : public Program {
 protected:
  EarlyEnd() {
    setenv("TMPDIR", work().c_str(), 1);  // where scratch folders are
    EXPECT_EQ(run("model piston --edge-length 5 -o part.off").exit_code, 0);
    EXPECT_EQ(run("mesh part.off -o part.vtu --report part.json").exit_code, 0);
    std::string surface = text_of(work() / "part.off");
    surface.replace(surface.rfind("\n3 "), std::string::npos, "\n3 0 1 2\n");  // a hole, and a facet too many
    write("broken.off", surface);
    write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "s", "inputs": [{"model": "cube", "edge_length": 0.5}],
                           "meshers": ["ccdt"], "repetitions": 2, "keep_meshes": true, "verify": true})");
    EXPECT_EQ(run("sweep spec.json -o swept").exit_code, 0);
    EXPECT_EQ(run("report swept").exit_code, 0);
  }
  ~EarlyEnd() override { unsetenv("TMPDIR"); }

  /// Every verb that writes. Their results are the same in each call, except for JSON.
  static std::vector<Call> calls() {
    return {
        {{"model", "piston", "--edge-length", "2", "-o", "m.off"}, {"m.off"}},
        {{"mesh", "part.off", "-o", "o.vtu", "--report", "r.json", "--threads", "2"},
         {"o.vtu", "o.boundary.vtu"},
         "r.json"},
        {{"mesh", "part.off", "-o", "o.xdmf"}, {"o.boundary.xdmf", "o.xdmf"}},
        {{"mesh", "part.off", "-o", "new", "--format", "polymesh"},
         {"new/points", "new/faces", "new/neighbour", "new/boundary", "new/owner"},
         {},
         "new"},
        {{"mesh", "part.off", "-o", "o.ele"}, {"o.face", "o.edge", "o.ele", "o.node"}},
        {{"mesh", "part.off", "-o", "o.mesh", "--surface", "remesh", "--edge-length", "5", "--surface-output", "s.off"},
         {"s.off", "o.mesh"}},
        {{"mesh", "part.off", "-o", "o.meshb", "--surface", "refine", "--edge-length", "5"}, {"o.meshb"}},
        {{"check", "part.off", "--report", "r.json"}, {"r.json"}},
        {{"check", "broken.off", "--repair", "-o", "c.off", "--limit", "5"}, {"c.off"}, {}, {}, {0, 3}},
        {{"improve", "part.vtu", "-o", "o.mesh"}, {"o.mesh"}},
        {{"verify", "part.off", "part.vtu", "--report", "r.json"}, {"r.json"}},
        {{"sweep", "spec.json", "-o", "new"}, {}, {}, "new"},
        {{"reproduce", "fig7", "--scale", "1000", "-o", "new"}, {}, {}, "new"},
        {{"report", "swept"}, {}, {}, "swept"},
        {{"gate", "part.json", "--against", "part.json", "--markdown", "g.md"}, {"g.md"}},
        {{"gate", "part.json", "--against", "b.json", "--update", "--reason", "a test"}, {"b.json"}},
        {{"man", "-o", "new"}, {}, {}, "new"},
    };
  }

  /// Starts the program. What it says goes to the file "said" beside the others.
  pid_t start(const Call& call, const SystemLimit* limit = nullptr) const {
    const pid_t child = fork();
    if (child != 0) return child;
    const int said = open((work() / "../said").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (chdir(work().c_str()) != 0 || dup2(said, STDOUT_FILENO) < 0 || dup2(said, STDERR_FILENO) < 0) _exit(126);
    if (limit != nullptr) {
      const rlimit value = {limit->bytes, limit->bytes};
      if (setrlimit(static_cast<__rlimit_resource>(limit->resource), &value) != 0) _exit(126);
    }
    signal(SIGINT, SIG_DFL);
    std::vector<char*> words = {const_cast<char*>(CCDT_PROGRAM)};
    for (const std::string& word : call.words) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execv(CCDT_PROGRAM, words.data());
    _exit(127);
  }

  /// \return  the exit code; 128 plus the signal that ended the program
  static int code_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  std::string said() const { return text_of(work() / "../said"); }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(work()))
      names.insert(entry.path().lexically_relative(work()));
    return names;
  }

  /// The results that are there, with their contents.
  std::map<std::string, std::string> results_of(const Call& call) const {
    std::map<std::string, std::string> results;
    for (const std::string& name : call.results)
      if (std::filesystem::exists(work() / name)) results[name] = name.ends_with(".json") ? "" : text_of(work() / name);
    return results;
  }

  /// Removes what a call has made.
  void remove_made(const std::set<std::string>& before) const {
    for (const std::string& name : files())
      if (!before.contains(name)) std::filesystem::remove_all(work() / name);
  }

  /// After an end that was not the call's own: only whole results may be there.
  void expect_no_remains(const Call& call, const std::set<std::string>& before,
                         const std::map<std::string, std::string>& whole) const {
    const auto results = results_of(call);
    for (const auto& [name, content] : results) EXPECT_EQ(content, whole.at(name)) << name << " is not whole";
    EXPECT_TRUE(results.empty() || results.contains(call.results.back())) << "only a part of the result is there";
    for (const std::string& name : files()) {
      const bool is_kept = !call.folder.empty() && name.starts_with(call.folder) && !name.ends_with(".tmp");
      EXPECT_TRUE(before.contains(name) || results.contains(name) || name == call.record || is_kept) << name;
    }
  }

  /// After a signal: a record that is there says so, unless the run was finished.
  void expect_interrupted(const Call& call) const {
    if (call.record.empty() || !std::filesystem::exists(work() / call.record)) return;
    const nlohmann::json record = nlohmann::json::parse(text_of(work() / call.record));
    EXPECT_EQ(record.value("kind", "interrupted"), "interrupted");
    EXPECT_EQ(record["status"], record.contains("kind") ? "failed" : "ok");
  }

  /// Calls the program undisturbed, and then `disturb(whole, seconds)`.
  template <class Disturb>
  void with_results_of(const Call& call, const Disturb& disturb) const {
    using Clock = std::chrono::steady_clock;
    SCOPED_TRACE(testing::PrintToString(call.words));
    const std::set<std::string> before = files();
    const auto begin = Clock::now();
    EXPECT_TRUE(call.ends.contains(code_of(start(call)))) << said();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    const auto whole = results_of(call);
    EXPECT_EQ(whole.size(), call.results.size());
    remove_made(before);
    disturb(before, whole, seconds);
  }

  /// Ends calls by signals at random moments of their usual time.
  void end_at_random(const Call& call) const {
    const char* many = std::getenv("CCDT_EARLY_ENDS");
    const int count = many == nullptr ? 5 : std::stoi(many);
    int ended = 0;
    with_results_of(call, [&](const auto& before, const auto& whole, double seconds) {
      std::mt19937 random(std::random_device{}());
      std::uniform_real_distribution<double> moment(0, seconds);
      for (int i = 0; i < count; ++i) {
        const int number = i % 2 == 0 ? SIGTERM : SIGINT;
        const pid_t child = start(call);
        std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
        kill(child, number);
        const int code = code_of(child);
        EXPECT_TRUE(code == 128 + number || call.ends.contains(code)) << code << "\n" << said();
        ended += code == 128 + number;
        if (code == 128 + number) expect_interrupted(call);
        expect_no_remains(call, before, whole);
        remove_made(before);
      }
    });
    RecordProperty(call.words.front() + "_ended", ended);
  }

  /// Calls the program under larger and larger limits.
  /// \param ends  the exit code at a limit
  /// \return      how many calls ended so
  int end_at_limits(const Call& call, int resource, const std::vector<rlim_t>& limits, int ends) const {
    int ended = 0;
    with_results_of(call, [&](const auto& before, const auto& whole, double /*seconds*/) {
      for (const rlim_t bytes : limits) {
        SCOPED_TRACE(bytes);
        const SystemLimit limit{resource, bytes};
        const int code = code_of(start(call, &limit));
        const bool has_started = code != 127;  // otherwise the system could not load the program
        EXPECT_TRUE(!has_started || code == ends || call.ends.contains(code)) << code << "\n" << said();
        ended += code == ends;
        if (call.ends.contains(code) && code != ends) {
          EXPECT_EQ(results_of(call), whole);
        }
        EXPECT_TRUE(code != limit_reached || names_work(call)) << said();
        expect_no_remains(call, before, whole);
        remove_made(before);
      }
    });
    return ended;
  }

 private:
  static constexpr int limit_reached = 4;

  /// Does the error name a file or folder of the call?
  bool names_work(const Call& call) const {
    const std::string text = said();
    return std::ranges::any_of(call.words, [&](const std::string& word) {
      const bool is_file = word.find('.') != std::string::npos || word == call.folder;
      return is_file && text.find(word) != std::string::npos;
    });
  }
};

TEST_F(EarlyEnd, BySignalsLeavesOnlyWholeResults) {
  for (const Call& call : calls()) end_at_random(call);
}

TEST_F(EarlyEnd, OfADescribedMesherRemovesItsScratchFolder) {
  ASSERT_EQ(run("mesh part.off -o good.mesh --lattice none").exit_code, 0);
  write("slow.json", R"({"schema": "ccdt.mesher/1", "name": "slow", "what": "a mesher", "licence": "MIT",
                         "command": ["/bin/sh", "-c", "sleep 0.4; cp )" +
                         (work() / "good.mesh").string() +
                         R"( out.mesh"], "input_format": "off", "output": "out.mesh"})");
  end_at_random(
      {{"mesh", "part.off", "-o", "o.vtu", "--mesher", "slow.json", "--report", "r.json"}, {"o.vtu"}, "r.json"});
}

TEST_F(EarlyEnd, WithoutMemoryIsALimitThatNamesTheFile) {
  std::vector<rlim_t> limits;
  for (const rlim_t megabytes : {20, 24, 26, 28, 30, 34, 38, 44, 50, 60, 80, 100, 200, 500})
    limits.push_back(megabytes * 1'000'000);
  int ended = 0;
  for (const Call& call : calls()) ended += end_at_limits(call, RLIMIT_AS, limits, 4);
  EXPECT_GT(ended, 0);
}

TEST_F(EarlyEnd, AtTheLargestSizeOfAFileIsAnErrorOfWriting) {
  for (const Call& call : calls()) EXPECT_GT(end_at_limits(call, RLIMIT_FSIZE, {0, 500, 1'000, 10'000, 100'000}, 3), 0);
}

TEST_F(EarlyEnd, OfStandardOutputIsAnError) {
  const auto code_of = [&](const std::string& arguments) {
    const std::string call = "cd " + work().string() + "; exec " + CCDT_PROGRAM + " " + arguments + " >/dev/full 2>&1";
    const int status = std::system(("sh -c '" + call + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  for (const std::string arguments :
       {"mesh part.off -o o.vtu", "check part.off", "man --markdown", "completion bash", "--help", "mesh --help",
        "help mesh", "--version", "version", "verify part.off part.vtu", "improve part.vtu -o o.mesh",
        "model cube -o o.off", "report swept", "sweep spec.json -o swept --status",
        "gate part.json --against part.json", "mesh part.off -o - --format mesh", "check part.off --report -"})
    EXPECT_EQ(code_of(arguments), 3) << arguments;
}

}  // namespace
}  // namespace ccdt
