#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

/// `-` as the name of a file.
class Streams : public Program {
 protected:
  Streams() {
    EXPECT_EQ(run("model cube --edge-length 0.25 -o cube.off").exit_code, 0);
    EXPECT_EQ(run("mesh cube.off -o cube.mesh").exit_code, 0);
  }

  std::string input(const std::string& name) const { return (work() / name).string(); }

  void expect_refused(const Outcome& outcome, int code) const {
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err, "");
  }
};

TEST_F(Streams, GiveTheSameMeshAsFiles) {
  for (const std::string format : {"mesh", "meshb", "msh", "msh4", "inp"}) {
    ASSERT_EQ(run("mesh cube.off -o file." + format).exit_code, 0);
    const Outcome outcome = run_on(input("cube.off"), "mesh - -o - --format " + format);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, text_of(work() / ("file." + format))) << format;
    EXPECT_NE(outcome.err, "") << "words go there";
  }
}

TEST_F(Streams, AreReadInTheFormatThatIsGiven) {
  ASSERT_EQ(run("check cube.off --repair -o cube.stl -q").exit_code, 0);
  EXPECT_EQ(run_on(input("cube.stl"), "check - --input-format stl").exit_code, 0);
  expect_refused(run_on(input("cube.stl"), "check -"), 3);
  std::filesystem::copy(work() / "cube.stl", work() / "cube.data");
  EXPECT_EQ(run("check cube.data --input-format stl").exit_code, 0);
  EXPECT_EQ(run_on(input("cube.mesh"), "verify cube.off - --mesh-format mesh").exit_code, 0);
  EXPECT_EQ(run_on(input("cube.off"), "verify - cube.mesh").exit_code, 0);
  expect_refused(run_on(input("cube.off"), "verify - -"), 2);
  expect_refused(run("check -"), 3);
}

TEST_F(Streams, OfOtherVerbsHoldWhatFilesDo) {
  ASSERT_EQ(run("improve cube.mesh -o better.mesh").exit_code, 0);
  EXPECT_EQ(run_on(input("cube.mesh"), "improve - --input-format mesh -o - --format mesh").out,
            text_of(work() / "better.mesh"));
  EXPECT_EQ(run("model cube --edge-length 0.25 -o - --format off").out, text_of(work() / "cube.off"));
  ASSERT_EQ(run("check cube.off --repair -o copy.ply").exit_code, 0);
  EXPECT_EQ(run("check cube.off --repair -o - --format ply").out, text_of(work() / "copy.ply"));
}

TEST_F(Streams, HoldNoFormatOfSeveralFiles) {
  for (const std::string format : {"vtu", "xdmf", "polymesh", "node", "ele", "face"}) {
    expect_refused(run("mesh cube.off -o - --format " + format), 3);
    expect_refused(run("improve cube.mesh -o - --format " + format), 3);
    expect_refused(run_on(input("cube.mesh"), "verify cube.off - --mesh-format " + format), 3);
  }
  for (const std::string arguments :
       {"mesh cube.off -o -", "improve cube.mesh -o -", "model cube -o -", "check cube.off --repair -o -"})
    expect_refused(run(arguments), 3);
}

TEST_F(Streams, GetReportsAndNothingElse) {
  ASSERT_EQ(run("mesh cube.off -o a.mesh --report r.json").exit_code, 0);
  const Outcome mesh = run_on(input("cube.off"), "mesh - -o a.mesh --report -");
  Json report = Json::parse(mesh.out), of_file = Json::parse(text_of(work() / "r.json"));
  EXPECT_EQ(report["counts"], of_file["counts"]);
  EXPECT_EQ(report["input"]["sha256"], of_file["input"]["sha256"]);
  EXPECT_NE(mesh.err, "");
  EXPECT_EQ(Json::parse(run("check cube.off --json").out)["schema"], "ccdt.check/1");
  EXPECT_EQ(Json::parse(run("verify cube.off cube.mesh --json").out)["ok"], true);
  EXPECT_EQ(Json::parse(run("mesh missing.off -o a.mesh --report -").out)["kind"], "invalid_input");
  EXPECT_EQ(Json::parse(run("mesh cube.off -o a.mesh --json").out)["counts"], of_file["counts"]);
  expect_refused(run("mesh cube.off -o - --format mesh --report -"), 2);
  expect_refused(run("mesh cube.off -o a.mesh --report r.json --json"), 2);
}

TEST_F(Streams, FromBrokenInputsGiveNothing) {
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  expect_refused(run_on(input("open.off"), "mesh - -o - --format mesh"), 3);
}

/// The program with its standard input and output in pipes that nobody serves.
class Waiting : public Streams {
 protected:
  Waiting() {
    setenv("TMPDIR", work().c_str(), 1);
    EXPECT_EQ(pipe2(in_, O_CLOEXEC), 0);
    EXPECT_EQ(pipe2(out_, O_CLOEXEC), 0);
  }
  ~Waiting() override {
    unsetenv("TMPDIR");
    for (const int descriptor : {in_[0], in_[1], out_[0], out_[1]}) close(descriptor);
  }

  /// \return  the exit code after the signal, which comes when `is_due()`
  template <class Due>
  int end(const std::string& arguments, int signal_number, const Due& is_due) const {
    const std::string call = "cd " + work().string() + " && exec " + CCDT_PROGRAM + " " + arguments;
    const pid_t child = fork();
    if (child == 0) {
      dup2(in_[0], STDIN_FILENO);
      dup2(out_[1], STDOUT_FILENO);
      signal(SIGINT, SIG_DFL);
      execl("/bin/sh", "sh", "-c", call.c_str(), nullptr);
      _exit(127);
    }
    for (int i = 0; i < 1000 && !is_due(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, signal_number);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Json report() const { return Json::parse(text_of(work() / "r.json")); }

  int in_[2], out_[2];
};

TEST_F(Waiting, RunThatIsInterruptedSaysInWhichStage) {
  ASSERT_EQ(::write(in_[1], "O", 1), 1);
  const auto reads = [&] {
    int left = 1;
    return ioctl(in_[0], FIONREAD, &left) == 0 && left == 0;
  };
  EXPECT_EQ(end("mesh - -o a.mesh --report r.json", SIGINT, reads), 130);
  EXPECT_EQ(report()["status"], "failed");
  EXPECT_EQ(report()["kind"], "interrupted");
  EXPECT_EQ(report()["stage"], "read");
}

TEST_F(Waiting, RunWhoseReaderIsSlowLeavesNoFileWhenItIsEnded) {
  ASSERT_EQ(run("model cube --edge-length 0.05 -o large.off").exit_code, 0);  // its mesh is larger than a pipe
  const std::size_t before = file_count();
  const auto writes = [&] {
    char first = 0;
    return read(out_[0], &first, 1) == 1;
  };
  EXPECT_EQ(end("mesh large.off -o - --format mesh --report r.json 2>/dev/null", SIGTERM, writes), 143);
  EXPECT_EQ(report()["kind"], "interrupted");
  EXPECT_EQ(report()["stage"], "write");
  EXPECT_EQ(file_count(), before + 1);
}

}  // namespace
}  // namespace ccdt
