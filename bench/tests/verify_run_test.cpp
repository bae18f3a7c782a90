#include "bench/run/verify_run.h"

#include <gtest/gtest.h>

#include <fstream>

#include "baselines/external_program.h"

namespace ccdt::bench {
namespace {

/// Stands for `ccdt verify`: lists its arguments, and reports what a file says.
constexpr const char* verifier = R"(#!/bin/sh
folder=$(dirname "$0")
echo "$*" >> "$folder/calls"
while [ "$1" != --report ]; do shift; done
[ -e "$folder/said" ] && cp "$folder/said" "$2"
)";

constexpr const char* right = R"({"schema": "ccdt.verify/1", "ok": true, "checks": [
  {"name": "positive orientation", "required": true, "checked": 120, "failed": 0},
  {"name": "vertices in use", "required": false, "checked": 40, "failed": 2}]})";

constexpr const char* wrong = R"({"schema": "ccdt.verify/1", "ok": false, "checks": [
  {"name": "positive orientation", "required": true, "checked": 120, "failed": 3},
  {"name": "vertices in use", "required": false, "checked": 40, "failed": 2},
  {"name": "volume", "required": true, "checked": 1, "failed": 0}]})";

class VerifyRun : public testing::Test {
 protected:
  VerifyRun() {
    std::ofstream(place_.program) << verifier;
    std::filesystem::permissions(place_.program, std::filesystem::perms::owner_all);
  }

  void say(const char* report) const { std::ofstream(folder_.path() / "said") << report; }

  /// The record of a run with this mesh.
  RunRecord verified(const std::string& fingerprint) const {
    RunRecord record;
    record.mesh_fingerprint = fingerprint;
    verify_run(place_, measured_, {"input.off", "mesh.vtu", folder_.path()}, record);
    return record;
  }

  std::vector<std::string> calls() const {
    std::vector<std::string> lines;
    std::ifstream file(folder_.path() / "calls");
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  /// Is this among the arguments of the last call?
  bool was_called_with(const std::string& words) const {
    return (" " + calls().back() + " ").find(" " + words + " ") != std::string::npos;
  }

  baselines::TemporaryFolder folder_;
  RunPlace place_ = {.program = folder_.path() / "program", .folder = folder_.path()};
  MeasuredCase measured_ = {.asked = {.name = "case", .group = "group", .input = "input.off", .verify = true}};
};

TEST_F(VerifyRun, LeavesARightMeshAlone) {
  say(right);
  const RunRecord record = verified("a");
  EXPECT_EQ(record.status, baselines::RunStatus::ok);
  ASSERT_TRUE(record.verification);
  EXPECT_TRUE(record.verification->right);
  EXPECT_TRUE(record.verification->checks.empty());
  EXPECT_TRUE(was_called_with("verify input.off mesh.vtu"));
}

TEST_F(VerifyRun, MakesAFailureOfAWrongMeshAndNamesTheCheck) {
  say(wrong);
  const RunRecord record = verified("a");
  EXPECT_EQ(record.status, baselines::RunStatus::failed);
  EXPECT_NE(record.reason.find("positive orientation: 3 of 120"), std::string::npos) << record.reason;
  ASSERT_TRUE(record.verification);
  EXPECT_FALSE(record.verification->right);
  ASSERT_EQ(record.verification->checks.size(), 1u) << "those that are not required, or did not fail, are not named";
  EXPECT_EQ(record.verification->checks[0].name, "positive orientation");
}

TEST_F(VerifyRun, ChecksAnEqualMeshOnceAndAnotherMeshAgain) {
  say(right);
  add_run(measured_, verified("a"));
  say(wrong);
  EXPECT_EQ(verified("a").status, baselines::RunStatus::ok);
  EXPECT_EQ(calls().size(), 1u);
  EXPECT_EQ(verified("b").status, baselines::RunStatus::failed);
  EXPECT_EQ(calls().size(), 2u);
}

TEST_F(VerifyRun, ChecksAMeshWithoutAFingerprintEachTime) {
  say(right);
  add_run(measured_, verified(""));
  say(wrong);
  EXPECT_EQ(verified("").status, baselines::RunStatus::failed);
}

TEST_F(VerifyRun, SaysSoIfTheVerifierSaysNothing) {
  const RunRecord record = verified("a");
  EXPECT_EQ(record.status, baselines::RunStatus::ok);
  EXPECT_FALSE(record.verification);
  EXPECT_EQ(record.notes.size(), 1u);
}

TEST_F(VerifyRun, HandsOnWhatTheVerifierMustKnow) {
  say(right);
  measured_.asked.options = {"--flatness", "1e-6", "--lattice", "bcc", "--boundary", "slide"};
  verified("a");
  EXPECT_TRUE(was_called_with("--flatness 1e-6"));
  EXPECT_TRUE(was_called_with("--boundary slide"));
  EXPECT_FALSE(was_called_with("--lattice bcc"));
  EXPECT_FALSE(was_called_with("--surface own"));
}

TEST_F(VerifyRun, AcceptsTheSurfaceOfAMesherThatMakesItsOwn) {
  say(right);
  const auto file = folder_.path() / "mine.json";
  std::ofstream(file) << R"({"schema": "ccdt.mesher/1", "name": "mine", "what": "a mesher", "licence": "MIT",
    "input_format": "off", "output": "out.vtu", "command": ["sh"], "keeps_surface": false})";
  measured_.asked.mesher = file.string();
  verified("a");
  EXPECT_TRUE(was_called_with("--surface own"));
}

}  // namespace
}  // namespace ccdt::bench
