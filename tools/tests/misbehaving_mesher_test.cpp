#include <nlohmann/json.hpp>

#include "baselines/external_program.h"
#include "baselines/process.h"
#include "bench/run/run_record.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

using baselines::FailureKind;
using Json = nlohmann::json;

/// A user's mesher that misbehaves. Each way of misbehaving has one kind of failure, whatever its messages.
class MisbehavingMesher : public Program {
 protected:
  MisbehavingMesher() {
    EXPECT_EQ(run("model cube --edge-length 0.5 -o part.off").exit_code, 0);
    EXPECT_EQ(run("mesh part.off -o good.mesh").exit_code, 0);
    EXPECT_EQ(run("mesh part.off -o good.vtu").exit_code, 0);
  }

  /// \param ending  of the mesh that it writes
  void describe(const Json& command, const std::string& ending = "mesh") const {
    write("mine.json", Json({{"schema", "ccdt.mesher/1"},
                             {"name", "mine"},
                             {"what", "a mesher"},
                             {"licence", "MIT"},
                             {"command", command},
                             {"input_format", "off"},
                             {"output", "out." + ending}})
                           .dump());
  }
  void describe_script(const std::string& script, const std::string& ending = "mesh") const {
    describe({"/bin/sh", "-c", script}, ending);
  }
  void describe_child(const std::string& how) const { describe({MISBEHAVING_CHILD, how}); }

  /// The kind of failure in the report of `ccdt mesh`.
  std::string kind() const {
    std::filesystem::remove(work() / "r.json");
    const Outcome meshed = run("mesh part.off -o part.vtu --mesher mine.json --report r.json");
    if (meshed.exit_code == 0) return "none";
    EXPECT_EQ(meshed.exit_code, 1) << meshed.err;
    EXPECT_FALSE(std::filesystem::exists(work() / "part.vtu"));
    const bench::RunRecord record = bench::read_run_record(work() / "r.json");
    EXPECT_NE(record.reason, "");
    EXPECT_EQ(record.status, record.kind ? baselines::status_of(*record.kind) : baselines::RunStatus::ok);
    return std::string(name_of(record.kind.value()));
  }

  /// The same when it runs with limits.
  FailureKind kind_with(const baselines::Limits& limits) const {
    const baselines::TemporaryFolder scratch;
    const auto report = work() / "r.json";
    std::filesystem::remove(report);
    const auto ended = baselines::run_program(
        {CCDT_PROGRAM, "mesh", "part.off", "-o", "part.vtu", "--mesher", "mine.json", "--report", report.string()},
        {.folder = work(), .limits = limits, .scratch = scratch.path()});
    EXPECT_TRUE(std::filesystem::exists(report)) << "it says what was asked for, even of a run that was killed";
    bench::RunRecord record = bench::read_run_record(report);
    EXPECT_EQ(record.mesher.name, "mine");
    bench::note_end(ended, record);
    return record.kind.value();
  }
};

TEST_F(MisbehavingMesher, ThatSegfaultsHasCrashed) {
  describe_child("segfault");
  EXPECT_EQ(kind(), "crashed");
  EXPECT_EQ(kind_with({.seconds = 60}), FailureKind::crashed);
  describe_script("'" + std::string(MISBEHAVING_CHILD) + "' segfault; exit $?");
  EXPECT_EQ(kind(), "crashed") << "a shell around it says so by its exit code";
  describe_child("abort");
  EXPECT_EQ(kind(), "crashed");
}

TEST_F(MisbehavingMesher, ThatTheKernelKillsRanOutOfMemory) {
  describe_child("kill-itself");
  EXPECT_EQ(kind(), "out_of_memory");
  EXPECT_EQ(kind_with({.seconds = 60}), FailureKind::out_of_memory);
}

TEST_F(MisbehavingMesher, ThatExitsWithAnErrorRefuses) {
  describe_child("fail");
  EXPECT_EQ(kind(), "refused");
  describe_script("echo 'out of memory, segmentation fault, timeout'; exit 1");
  EXPECT_EQ(kind(), "refused") << "words do not matter";
  EXPECT_EQ(kind_with({.seconds = 60}), FailureKind::refused);
}

TEST_F(MisbehavingMesher, ThatHangsMeetsTheLimitOfTime) {
  describe_child("sleep-in-grandchild");
  EXPECT_EQ(kind_with({.seconds = 2}), FailureKind::timeout);
}

TEST_F(MisbehavingMesher, ThatAllocatesWithoutEndMeetsTheLimitOfMemory) {
  for (const char* how : {"eat-memory", "eat-memory-in-grandchild"}) {
    describe_child(how);
    EXPECT_EQ(kind_with({.seconds = 60, .memory_bytes = 200u << 20}), FailureKind::out_of_memory) << how;
  }
}

TEST_F(MisbehavingMesher, ThatWritesWithoutEndMeetsTheLimitOfTheDisk) {
  describe_child("fill-disk");
  EXPECT_EQ(kind_with({.seconds = 60, .disk_bytes = 50u << 20}), FailureKind::limit);
  describe({MISBEHAVING_CHILD, "fill-disk", "out.mesh"});
  EXPECT_EQ(kind_with({.seconds = 60, .disk_bytes = 50u << 20}), FailureKind::limit) << "in the folder of the run";
  describe_child("print-without-end");
  EXPECT_EQ(kind_with({.seconds = 60, .disk_bytes = 50u << 20}), FailureKind::limit) << "to its log";
}

TEST_F(MisbehavingMesher, ThatWritesHalfAMeshIsWrong) {
  for (const std::string ending : {"mesh", "vtu"}) {
    const std::string good = (work() / ("good." + ending)).string();
    describe_script("cp '" + good + "' out." + ending, ending);
    EXPECT_EQ(kind(), "none");
    std::filesystem::remove(work() / "part.vtu");
    const auto size = std::filesystem::file_size(good);
    for (const std::uintmax_t percent : {0, 50, 97}) {
      describe_script("head -c " + std::to_string(size * percent / 100) + " '" + good + "' >out." + ending, ending);
      EXPECT_EQ(kind(), "wrong") << percent << "% of " << good;
    }
  }
  describe_script("echo done");
  EXPECT_EQ(kind(), "wrong") << "no mesh at all";
  describe_script("mkfifo out.mesh");
  EXPECT_EQ(kind(), "wrong") << "no file";
}

TEST_F(MisbehavingMesher, IsNotToBlameForAnInputThatCannotBeRead) {
  describe_child("segfault");
  write("part.off", "OFF\n1 2");
  EXPECT_EQ(run("mesh part.off -o part.vtu --mesher mine.json --report r.json").exit_code, 3);
  EXPECT_EQ(bench::read_run_record(work() / "r.json").kind, FailureKind::invalid_input);
}

}  // namespace
}  // namespace ccdt
