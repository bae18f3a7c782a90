#include "baselines/process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "baselines/external_program.h"

namespace ccdt {
namespace {

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

TEST(RunProgram, ThatDoesNotExistIsAFailureWithAReason) {
  const baselines::ProcessResult result = baselines::run_program({"/nowhere/no-such-program"});
  EXPECT_EQ(result.status, baselines::RunStatus::failed);
  EXPECT_NE(result.reason.find("cannot be started"), std::string::npos) << result.reason;
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
