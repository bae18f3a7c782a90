#include "baselines/process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "baselines/external_program.h"

namespace ccdt {
namespace {

using baselines::FailureKind;
using baselines::RunStatus;

baselines::ProcessResult run(const std::string& how, const baselines::Limits& limits = {}) {
  return baselines::run_program({MISBEHAVING_CHILD, how}, {.limits = limits});
}

TEST(RunProgram, ThatSucceedsIsOk) {
  const baselines::ProcessResult result = run("well");
  EXPECT_EQ(result.status, baselines::RunStatus::ok);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.reason, "");
}

TEST(RunProgram, ThatFailsGivesItsOwnWordsAsReason) {
  const baselines::ProcessResult result = run("fail");
  EXPECT_EQ(result.status, baselines::RunStatus::failed);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.reason, "the child's own words");
}

TEST(RunProgram, ThatAbortsIsACrashWithTheSignalsName) {
  const baselines::ProcessResult result = run("abort");
  EXPECT_EQ(result.status, baselines::RunStatus::crashed);
  EXPECT_EQ(result.signal, SIGABRT);
  EXPECT_NE(result.reason.find("SIGABRT"), std::string::npos) << result.reason;
}

TEST(RunProgram, ThatSleepsPastItsLimitIsATimeout) {
  const baselines::ProcessResult result = run("sleep", {.seconds = 0.2});
  EXPECT_EQ(result.status, baselines::RunStatus::timeout);
  EXPECT_NE(result.reason.find("0.2 s"), std::string::npos) << result.reason;
  EXPECT_GE(result.seconds, 0.2);
  EXPECT_LT(result.seconds, 10);
}

TEST(RunProgram, TakesItsOwnChildrenWithItAtTheLimit) {
  const baselines::ProcessResult result = run("sleep-in-grandchild", {.seconds = 0.2});
  EXPECT_EQ(result.status, baselines::RunStatus::timeout);
  EXPECT_LT(result.seconds, 10);
}

TEST(RunProgram, ThatEatsMemoryIsStoppedAtTheLimit) {
  const baselines::ProcessResult result = run("eat-memory", {.seconds = 60, .memory_bytes = 200u << 20});
  EXPECT_EQ(result.status, baselines::RunStatus::out_of_memory);
  EXPECT_NE(result.reason.find("200 MiB"), std::string::npos) << result.reason;
}

TEST(RunProgram, IsStoppedForTheMemoryOfItsChildren) {
  const baselines::ProcessResult result = run("eat-memory-in-grandchild", {.seconds = 60, .memory_bytes = 200u << 20});
  EXPECT_EQ(result.kind, FailureKind::out_of_memory);
}

TEST(RunProgram, MayShareMemoryWithItsChildrenWhichCountsOnce) {
  EXPECT_EQ(run("share-memory-with-children", {.seconds = 60, .memory_bytes = 150u << 20}).reason, "");
  EXPECT_EQ(run("share-memory-with-children", {.seconds = 60, .memory_bytes = 50u << 20}).kind,
            FailureKind::out_of_memory);
}

TEST(RunProgram, ThatFillsItsScratchFolderIsStoppedAtTheLimit) {
  const baselines::TemporaryFolder scratch;
  const auto run_there = [&](std::uint64_t bytes) {
    return baselines::run_program(
        {MISBEHAVING_CHILD, "fill-disk"},
        {.limits = baselines::Limits{.seconds = 60, .disk_bytes = bytes}, .scratch = scratch.path()});
  };
  const baselines::ProcessResult result = run_there(30u << 20);
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.kind, FailureKind::limit);
  EXPECT_NE(result.reason.find("30 MiB"), std::string::npos) << result.reason;
}

TEST(RunProgram, ThatPrintsWithoutEndIsStoppedAtTheLimit) {
  EXPECT_EQ(run("print-without-end", {.seconds = 60, .disk_bytes = 30u << 20}).kind, FailureKind::limit);
}

TEST(RunProgram, ThatIsKilledFromOutsideCountsAsOutOfMemory) {
  const baselines::ProcessResult result = run("kill-itself");
  EXPECT_EQ(result.status, RunStatus::out_of_memory);
  EXPECT_EQ(result.kind, FailureKind::out_of_memory);
  EXPECT_EQ(result.signal, SIGKILL);
}

TEST(RunProgram, WithoutLimitsEndsInTheSameWays) {
  const auto without = [](const std::string& how) { return baselines::run_program({MISBEHAVING_CHILD, how}); };
  EXPECT_FALSE(without("well").kind);
  EXPECT_EQ(without("fail").kind, FailureKind::refused);
  EXPECT_EQ(without("segfault").kind, FailureKind::crashed);
}

/// A program that leaves behind a process outside its group and session.
class ServerOfProgram : public testing::Test {
 protected:
  std::vector<std::string> command(const std::string& how) const {
    return {MISBEHAVING_CHILD, how, pid_file_.string()};
  }

  /// Waits until the server has written its process ID.
  pid_t pid() const {
    for (int i = 0; i < 5000 && !std::filesystem::exists(pid_file_); ++i) usleep(1000);
    pid_t pid = 0;
    std::ifstream(pid_file_) >> pid;
    EXPECT_GT(pid, 0);
    return pid;
  }

  static bool is_there(pid_t process) { return kill(process, 0) == 0; }

 private:
  baselines::TemporaryFolder folder_;
  std::filesystem::path pid_file_ = folder_.path() / "pid";
};

TEST_F(ServerOfProgram, DiesAtALimit) {
  const auto result = baselines::run_program(command("leave-a-server-and-print"),
                                             {.limits = baselines::Limits{.disk_bytes = 10u << 20}});
  EXPECT_EQ(result.kind, FailureKind::limit);
  EXPECT_FALSE(is_there(pid()));
}

TEST_F(ServerOfProgram, DiesWithTheProgram) {
  const auto result = baselines::run_program(command("leave-a-server"), {.limits = baselines::Limits()});
  EXPECT_EQ(result.reason, "");
  EXPECT_FALSE(is_there(pid()));
}

TEST(RunProgram, WhoseSupervisorIsToldToEndHasCrashed) {
  const auto result =
      baselines::run_program({"/bin/sh", "-c", "kill -TERM $PPID; sleep 60"}, {.limits = baselines::Limits()});
  EXPECT_EQ(result.kind, FailureKind::crashed);
  EXPECT_EQ(result.signal, SIGTERM);
}

TEST_F(ServerOfProgram, DiesWithTheProcessThatStartedTheProgram) {
  const pid_t parent = fork();
  if (parent == 0) {
    baselines::run_program(command("leave-a-server-and-sleep"), {.limits = baselines::Limits()});
    _exit(0);
  }
  const pid_t server = pid();
  EXPECT_TRUE(is_there(server));
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  for (int i = 0; i < 5000 && is_there(server); ++i) usleep(1000);
  EXPECT_FALSE(is_there(server));
}

TEST(RunProgram, WorksInSeveralThreads) {
  std::vector<baselines::ProcessResult> results(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < results.size(); ++i)
    threads.emplace_back([&results, i] {
      results[i] =
          baselines::run_program({"/bin/sh", "-c", "echo " + std::to_string(i) + " >&2; exit " + std::to_string(i)},
                                 {.limits = baselines::Limits{.seconds = 60, .memory_bytes = 1u << 30}});
    });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].exit_code, static_cast<int>(i));
    EXPECT_EQ(results[i].printed, std::to_string(i));
  }
}

TEST(RunProgram, EndsAtOnceWhenTheProcessIsToStop) {
  // In a fork, so that only the fork stops.
  const baselines::ProcessResult fork = baselines::run_function([] {
    std::thread user([] {
      usleep(50000);
      baselines::request_stop();
    });
    std::string text;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 2; ++i) try {
        run("sleep-in-grandchild", {.seconds = 60});
      } catch (const baselines::Stopped&) {
        text += "stopped ";
      }
    user.join();
    const bool is_soon = std::chrono::steady_clock::now() - begin < std::chrono::seconds(20);
    return text + (is_soon ? "soon" : "late") + (baselines::stop_requested() ? "" : ", for no reason");
  });
  EXPECT_EQ(fork.value, "stopped stopped soon") << fork.reason;
  EXPECT_FALSE(baselines::stop_requested());
}

TEST(RunProgram, ThatEndsTogetherWithTheProcessHasNotFailed) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const baselines::ProcessResult fork = baselines::run_function([]() -> std::string {
      std::signal(SIGTERM, [](int) { baselines::request_stop(); });
      const std::string end_both = "kill -TERM " + std::to_string(getpid()) + "; kill -KILL $$";
      try {
        baselines::run_program({"/bin/sh", "-c", end_both}, {.limits = baselines::Limits{.seconds = 60}});
      } catch (const baselines::Stopped&) {
        return "stopped";
      }
      return "failed";
    });
    ASSERT_EQ(fork.value, "stopped") << fork.reason;
  }
}

TEST(RunProgram, ThatDoesNotExistIsAFailureWithAReason) {
  const baselines::ProcessResult result = baselines::run_program({"/nowhere/no-such-program"});
  EXPECT_EQ(result.status, baselines::RunStatus::failed);
  EXPECT_FALSE(result.reason.empty());
}

TEST(RunProgram, DoesNotPrintIntoTheCallersOutput) {
  testing::internal::CaptureStdout();
  run("print");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(RunProgram, LogsWhatIsPrintedAndSaysHowItEnded) {
  const baselines::TemporaryFolder folder;
  const auto log = folder.path() / "log";
  const auto code = [&](const std::vector<std::string>& command) {
    return baselines::run_program(command, {.log = log}).shell_code();
  };
  EXPECT_EQ(code({"/bin/sh", "-c", "echo out; echo err >&2; exit 3"}), 3);
  EXPECT_EQ(text_of(log), "out\nerr\n");
  EXPECT_EQ(code({"/bin/sh", "-c", "kill -9 $$"}), 128 + 9);
  EXPECT_EQ(code({"/nowhere/sh"}), 127);
  EXPECT_THROW(baselines::run_program({"/bin/sh"}, {.log = folder.path() / "nowhere" / "log"}), std::system_error);
}

TEST(RunProgram, RunsInAFolderAndWithVariablesOfItsOwn) {
  const baselines::TemporaryFolder folder;
  const auto log = folder.path() / "log";
  const baselines::ProgramOptions there{
      .folder = folder.path(), .environment = {{"CCDT_TEST_WORD", "a word"}, {"HOME", "/nowhere"}}, .log = log};
  EXPECT_EQ(baselines::run_program({"/bin/sh", "-c", "pwd -P; echo \"$CCDT_TEST_WORD $HOME\""}, there).exit_code, 0);
  EXPECT_EQ(text_of(log), std::filesystem::canonical(folder.path()).string() + "\na word /nowhere\n");
  EXPECT_EQ(baselines::run_program({"/bin/sh"}, {.folder = folder.path() / "nowhere"}).exit_code, 127);
}

TEST(RunFunction, ReturnsItsBytesAndPrintsNothingHere) {
  testing::internal::CaptureStdout();
  const baselines::ProcessResult result = baselines::run_function([] {
    std::puts("some words");
    return std::string("a\0b", 3);
  });
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(result.value, std::string("a\0b", 3));
  EXPECT_EQ(result.printed, "some words");
  EXPECT_EQ(baselines::run_function([] { return std::string(); }).value, "");
}

TEST(RunFunction, ThatExitsOrCrashesHasNoValue) {
  const auto exits = [](int code) { return baselines::run_function([=]() -> std::string { std::exit(code); }); };
  EXPECT_FALSE(exits(0).value);
  EXPECT_EQ(exits(3).exit_code, 3);
  const baselines::ProcessResult crashed = baselines::run_function([]() -> std::string { std::abort(); });
  EXPECT_FALSE(crashed.value);
  EXPECT_EQ(crashed.signal, SIGABRT);
}

TEST(RunStatus, ReadsBackFromItsName) {
  for (const auto status : {baselines::RunStatus::ok, baselines::RunStatus::failed, baselines::RunStatus::timeout,
                            baselines::RunStatus::out_of_memory, baselines::RunStatus::crashed})
    EXPECT_EQ(value_of<baselines::RunStatus>(name_of(status)), status);
  EXPECT_FALSE(value_of<baselines::RunStatus>("fine"));
}

}  // namespace
}  // namespace ccdt
