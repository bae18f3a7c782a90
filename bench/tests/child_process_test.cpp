#include "bench/child_process.h"

#include <gtest/gtest.h>

#include <csignal>

namespace ccdt {
namespace {

ChildResult run(const std::string& how, const Limits& limits = {}) {
  return run_child({MISBEHAVING_CHILD, how}, limits);
}

TEST(ChildProcess, ThatSucceedsIsOk) {
  const ChildResult result = run("well");
  EXPECT_EQ(result.status, RunStatus::ok);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.reason, "");
}

TEST(ChildProcess, ThatFailsGivesItsOwnWordsAsReason) {
  const ChildResult result = run("fail");
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.reason, "the child's own words");
}

TEST(ChildProcess, ThatAbortsIsACrashWithTheSignalsName) {
  const ChildResult result = run("abort");
  EXPECT_EQ(result.status, RunStatus::crashed);
  EXPECT_EQ(result.signal, SIGABRT);
  EXPECT_NE(result.reason.find("SIGABRT"), std::string::npos) << result.reason;
}

TEST(ChildProcess, ThatSleepsPastItsLimitIsATimeout) {
  const ChildResult result = run("sleep", {.seconds = 0.2});
  EXPECT_EQ(result.status, RunStatus::timeout);
  EXPECT_NE(result.reason.find("0.2 s"), std::string::npos) << result.reason;
  EXPECT_GE(result.seconds, 0.2);
  EXPECT_LT(result.seconds, 10);
}

TEST(ChildProcess, TakesItsOwnChildrenWithItAtTheLimit) {
  const ChildResult result = run("sleep-in-grandchild", {.seconds = 0.2});
  EXPECT_EQ(result.status, RunStatus::timeout);
  EXPECT_LT(result.seconds, 10);
}

TEST(ChildProcess, ThatEatsMemoryIsStoppedAtTheLimit) {
  const ChildResult result = run("eat-memory", {.seconds = 60, .memory_bytes = 200u << 20});
  EXPECT_EQ(result.status, RunStatus::out_of_memory);
  EXPECT_NE(result.reason.find("200 MiB"), std::string::npos) << result.reason;
}

TEST(ChildProcess, ThatDoesNotExistIsAFailureWithAReason) {
  const ChildResult result = run_child({"/nowhere/no-such-program"});
  EXPECT_EQ(result.status, RunStatus::failed);
  EXPECT_NE(result.reason.find("cannot be started"), std::string::npos) << result.reason;
}

TEST(ChildProcess, DoesNotPrintIntoTheCallersOutput) {
  testing::internal::CaptureStdout();
  run("print");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(RunStatus, ReadsBackFromItsName) {
  for (const auto status :
       {RunStatus::ok, RunStatus::failed, RunStatus::timeout, RunStatus::out_of_memory, RunStatus::crashed})
    EXPECT_EQ(run_status(name_of(status)), status);
  EXPECT_THROW(run_status("fine"), std::invalid_argument);
}

}  // namespace
}  // namespace ccdt
