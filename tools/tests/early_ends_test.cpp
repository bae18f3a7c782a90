#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// Ends that come from outside: signals, limits of memory, a full disk. What a call wrote for itself goes with it.
class EarlyEnd : public Program {
 protected:
  EarlyEnd() {
    setenv("TMPDIR", work().c_str(), 1);  // where scratch folders are
    EXPECT_EQ(run("model piston --edge-length 5 -o part.off").exit_code, 0);
  }
  ~EarlyEnd() override { unsetenv("TMPDIR"); }

  /// Starts the program.
  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(work().c_str()) != 0) _exit(126);
    if (freopen("/dev/null", "w", stdout) == nullptr || freopen("/dev/null", "w", stderr) == nullptr) _exit(126);
    signal(SIGINT, SIG_DFL);
    std::vector<char*> words = {const_cast<char*>(CCDT_PROGRAM)};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execv(CCDT_PROGRAM, words.data());
    _exit(127);
  }

  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(work())) names.insert(entry.path().filename());
    return names;
  }

  /// Ends calls by signals at random moments of their usual time.
  /// \return  how many were ended before they were done
  int end_at_random(const std::vector<std::string>& arguments, std::set<std::string> results) const {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    int status = 0;
    waitpid(start(arguments), &status, 0);
    double usual = std::chrono::duration<double>(Clock::now() - begin).count();
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    for (const std::string& result : results) std::filesystem::remove(work() / result);
    const std::set<std::string> before = files();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> moment(0.02, usual);
    int ended = 0, ended_by_handler = 0;
    for (int i = 0; i < 24; ++i) {
      const int number = i % 2 == 0 ? SIGTERM : SIGINT;
      const pid_t child = start(arguments);
      std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
      kill(child, number);
      waitpid(child, &status, 0);
      // A signal that comes before the program handles it ends it at once; nothing is written yet.
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      EXPECT_TRUE(code == 0 || code == 128 + number) << code;
      ended += code != 0;
      ended_by_handler += WIFEXITED(status) && code != 0;
      if (code == 0) usual = std::max(0.8 * usual, 0.03);  // a call that is done was not as slow as the first one
      for (const std::string& result : results) std::filesystem::remove(work() / result);
      EXPECT_EQ(files(), before) << "after signal " << number;
    }
    EXPECT_GT(ended_by_handler, 0);
    return ended;
  }
};

TEST_F(EarlyEnd, BySignalsLeavesNothing) {
  EXPECT_GT(end_at_random({"mesh", "part.off", "-o", "o.vtu"}, {"o.vtu"}), 5);
  EXPECT_GT(end_at_random({"mesh", "part.off", "-o", "o.node"}, {"o.node", "o.ele", "o.face", "o.edge"}), 5);
  EXPECT_GT(end_at_random({"check", "part.off", "--repair", "-o", "copy.off"}, {"copy.off"}), 2);
}

TEST_F(EarlyEnd, OfADescribedMesherRemovesItsScratchFolder) {
  ASSERT_EQ(run("mesh part.off -o good.mesh --lattice none").exit_code, 0);
  write("slow.json", R"({"schema": "ccdt.mesher/1", "name": "slow", "what": "a mesher", "licence": "MIT",
                         "command": ["/bin/sh", "-c", "sleep 0.4; cp )" +
                         (work() / "good.mesh").string() +
                         R"( out.mesh"], "input_format": "off", "output": "out.mesh"})");
  EXPECT_GT(end_at_random({"mesh", "part.off", "-o", "o.vtu", "--mesher", "slow.json"}, {"o.vtu"}), 5);
}

TEST_F(EarlyEnd, WithoutMemoryIsALimitThatNamesStageAndFile) {
  int limits = 0;
  for (const int megabytes : {20, 24, 28, 34, 40, 60, 100}) {
    const std::set<std::string> before = files();
    const std::string call = "ulimit -v " + std::to_string(megabytes) + "000; cd " + work().string() + "; exec " +
                             CCDT_PROGRAM + " mesh part.off -o o.vtu --threads 2 2>err.txt";
    const int status = std::system(("sh -c '" + call + "' >/dev/null").c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    const std::string error = text_of(work() / "err.txt");
    std::filesystem::remove(work() / "err.txt");
    const bool has_started = code != 127;  // otherwise the system could not load the program
    EXPECT_TRUE(!has_started || code == 0 || code == 4) << megabytes << " MB: " << code << " " << error;
    limits += code == 4;
    std::filesystem::remove(work() / "o.vtu");
    EXPECT_EQ(files(), before) << megabytes;
  }
  EXPECT_GT(limits, 0);
}

TEST_F(EarlyEnd, OfStandardOutputIsAnError) {
  const auto code_of = [&](const std::string& arguments) {
    const std::string call = "cd " + work().string() + "; exec " + CCDT_PROGRAM + " " + arguments + " >/dev/full 2>&1";
    const int status = std::system(("sh -c '" + call + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  for (const std::string arguments : {"mesh part.off -o o.vtu", "check part.off", "man --markdown", "completion bash"})
    EXPECT_EQ(code_of(arguments), 3) << arguments;
}

}  // namespace
}  // namespace ccdt
