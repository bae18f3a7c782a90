#include "baselines/failure.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <system_error>

namespace ccdt {
namespace {

using baselines::failure_kind_of;
using baselines::FailureKind;
using baselines::RunStatus;

TEST(FailureKind, FollowsFromTheTypeOfAnError) {
  EXPECT_EQ(failure_kind_of(InputError("out of memory", {}, "")), FailureKind::invalid_input);
  EXPECT_EQ(failure_kind_of(LimitError("crashed", {}, "")), FailureKind::limit);
  EXPECT_EQ(failure_kind_of(OutputError("", {}, "")), FailureKind::limit);
  EXPECT_EQ(failure_kind_of(MeshError("timeout", {}, "")), FailureKind::refused);
  EXPECT_EQ(failure_kind_of(Error("", {}, "")), FailureKind::refused);
  EXPECT_EQ(failure_kind_of(baselines::MesherError(FailureKind::wrong, "", {}, "")), FailureKind::wrong);
  EXPECT_EQ(failure_kind_of(std::bad_alloc()), FailureKind::out_of_memory);
  EXPECT_EQ(failure_kind_of(std::out_of_range("a limit")), FailureKind::crashed);
}

TEST(FailureKind, OfASystemErrorFollowsFromItsCode) {
  const auto of = [](std::errc code) { return failure_kind_of(std::system_error(std::make_error_code(code))); };
  EXPECT_EQ(of(std::errc::no_space_on_device), FailureKind::limit);
  EXPECT_EQ(of(std::errc::not_enough_memory), FailureKind::out_of_memory);
  EXPECT_EQ(of(std::errc::bad_address), FailureKind::crashed);
}

TEST(FailureKind, OfAnExitCodeAbove128IsThatOfTheSignal) {
  EXPECT_EQ(baselines::failure_kind_of_exit_code(1), FailureKind::refused);
  EXPECT_EQ(baselines::failure_kind_of_exit_code(255), FailureKind::refused);
  EXPECT_EQ(baselines::failure_kind_of_exit_code(128 + SIGSEGV), FailureKind::crashed);
  EXPECT_EQ(baselines::failure_kind_of_exit_code(128 + SIGKILL), FailureKind::out_of_memory);
}

TEST(FailureKind, GivesTheStatusOfTheRun) {
  for (const auto& kind : names_of(FailureKind{})) EXPECT_NE(baselines::status_of(kind.value), RunStatus::ok);
  EXPECT_EQ(baselines::status_of(FailureKind::crashed), RunStatus::crashed);
  EXPECT_EQ(baselines::status_of(FailureKind::timeout), RunStatus::timeout);
  EXPECT_EQ(baselines::status_of(FailureKind::out_of_memory), RunStatus::out_of_memory);
  EXPECT_EQ(baselines::status_of(FailureKind::wrong), RunStatus::failed);
}

}  // namespace
}  // namespace ccdt
