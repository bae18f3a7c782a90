#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

class SweepCommand : public Program {
 protected:
  void write_spec(const Json& members = Json::object()) const {
    Json spec = {{"schema", "ccdt.sweep/1"},
                 {"inputs", {{{"model", "cube"}, {"edge_length", {1, 0.5}}}}},
                 {"options", {{"lattice", {"fcc", "none"}}}}};
    spec.update(members);
    write("spec.json", spec.dump());
  }

  /// A mesher that takes a moment, counts its calls and fails unless there is a file "works".
  void write_mesher() const {
    write("mesher.sh", "#!/bin/sh\necho called >>'" + (work() / "calls").string() + "'\nsleep 0.2\ntest -e '" +
                           (work() / "works").string() + "' && cp '" + (work() / "mesh.vtu").string() + "' out.vtu\n");
    std::filesystem::permissions(work() / "mesher.sh", std::filesystem::perms::owner_all);
    write("mesher.json", Json{{"schema", "ccdt.mesher/1"},
                              {"name", "mine"},
                              {"what", "a mesher"},
                              {"licence", "MIT"},
                              {"command", {"./mesher.sh"}},
                              {"input_format", "off"},
                              {"output", "out.vtu"}}
                             .dump());
  }
  std::size_t calls() const {
    const std::string text = text_of(work() / "calls");
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
  }

  Outcome sweep(const std::string& options = "") const { return run("sweep spec.json -o out " + options); }

  Json json(const std::string& options) const {
    const Outcome outcome = sweep(options + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  Json status() const { return json("--status"); }

  std::map<std::string, std::string> records() const {
    std::map<std::string, std::string> all;
    if (!std::filesystem::exists(work() / "out/runs")) return all;
    for (const auto& entry : std::filesystem::directory_iterator(work() / "out/runs"))
      all[entry.path().filename()] = text_of(entry.path());
    return all;
  }
  void write_record(const std::string& name, const std::string& text) const { write("out/runs/" + name, text); }

  Json sweep_json() const { return Json::parse(text_of(work() / "out/sweep.json"), nullptr, false); }

  /// The program with one more byte: it does the same but is a different program.
  int other_program(const std::string& arguments) const {
    const auto other = work() / "other-ccdt";
    std::filesystem::copy_file(CCDT_PROGRAM, other, std::filesystem::copy_options::overwrite_existing);
    std::ofstream(other, std::ios::binary | std::ios::app) << ' ';
    const std::string command = "cd '" + work().string() + "' && ./other-ccdt " + arguments + " >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Starts a sweep, and returns at once.
  pid_t start_sweep() const {
    const pid_t child = fork();
    if (child == 0) {
      std::filesystem::current_path(work());
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      execl(CCDT_PROGRAM, CCDT_PROGRAM, "sweep", "spec.json", "-o", "out", nullptr);
      _exit(127);
    }
    return child;
  }

  bool wait_for_records(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (records().size() < count && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return records().size() >= count;
  }
};

TEST_F(SweepCommand, RunsEachCaseOnceAndNothingTwice) {
  write_spec({{"repetitions", 2}, {"verify", true}});
  const Outcome first = sweep();
  ASSERT_EQ(first.exit_code, 0) << first.out << first.err;
  const auto made = records();
  EXPECT_EQ(made.size(), 4u * 3u);
  const Json known = sweep_json();
  EXPECT_EQ(known["schema"], "ccdt.sweep/1");
  EXPECT_EQ(known["cases"].size(), 4u);
  EXPECT_TRUE(known["identity"].contains("ccdt.binary"));
  for (const Json& one : known["cases"])
    for (const char* number : {"-0.json", "-1.json", "-2.json"}) {
      const auto record = made.find(one["id"].get<std::string>() + number);
      ASSERT_NE(record, made.end()) << one;
      EXPECT_EQ(Json::parse(record->second)["status"], "ok");
    }
  EXPECT_EQ(sweep().exit_code, 0);
  EXPECT_EQ(records(), made);
}

TEST_F(SweepCommand, SaysHowFarItIs) {
  write_spec();
  EXPECT_EQ(status()["missing"], 4);
  EXPECT_FALSE(std::filesystem::exists(work() / "out"));
  ASSERT_EQ(sweep().exit_code, 0);
  const Json all = status();
  EXPECT_EQ(all["cases"], 4);
  EXPECT_EQ(all["runs"], 4);
  EXPECT_EQ(all["finished"], 4);
  EXPECT_EQ(all["failed"], 0);
  EXPECT_EQ(all["missing"], 0);
  EXPECT_EQ(all["obsolete"], 0);
}

TEST_F(SweepCommand, RunsAgainWhatIsLostOrTorn) {
  write_spec();
  ASSERT_EQ(sweep().exit_code, 0);
  const auto before = records();
  const std::string lost = before.begin()->first, torn = before.rbegin()->first;
  std::filesystem::remove(work() / "out/runs" / lost);
  write_record(torn, before.at(torn).substr(0, before.at(torn).size() / 2));
  EXPECT_EQ(status()["missing"], 2);
  ASSERT_EQ(sweep().exit_code, 0);
  const auto after = records();
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [name, text] : after) {
    const Json then = Json::parse(before.at(name)), now = Json::parse(text, nullptr, false);
    EXPECT_EQ(then == now, name != lost && name != torn) << name;
    EXPECT_EQ(then["counts"], now["counts"]);
  }
}

TEST_F(SweepCommand, GoesOnWithAnotherSpec) {
  write_spec();
  ASSERT_EQ(sweep().exit_code, 0);
  const auto before = records();
  write_spec({{"options", {{"lattice", {"none", "bcc"}}}}});
  EXPECT_EQ(status()["missing"], 2);
  const Outcome outcome = sweep();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("cube-0.5, ccdt, lattice bcc"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("cube-0.5, ccdt, lattice fcc"), std::string::npos) << outcome.out;
  const auto after = records();
  EXPECT_EQ(after.size(), 6u);
  for (const auto& [name, text] : before) EXPECT_EQ(after.at(name), text);
  EXPECT_EQ(status()["obsolete"], 2);
  EXPECT_EQ(status()["finished"], 4);
}

TEST_F(SweepCommand, DoesNotMixTwoProgramsUnlessTold) {
  write_spec();
  ASSERT_EQ(sweep().exit_code, 0);
  const auto before = records();
  EXPECT_EQ(other_program("sweep spec.json -o out"), 3);
  EXPECT_NE(text_of(work() / "err.txt").find("ccdt.binary"), std::string::npos) << text_of(work() / "err.txt");
  EXPECT_EQ(records(), before);

  std::filesystem::copy(work() / "out", work() / "kept", std::filesystem::copy_options::recursive);
  EXPECT_EQ(other_program("sweep spec.json -o out --mixed"), 0);
  EXPECT_EQ(records(), before);

  std::filesystem::remove_all(work() / "out");
  std::filesystem::rename(work() / "kept", work() / "out");
  EXPECT_EQ(other_program("sweep spec.json -o out --refresh"), 0);
  EXPECT_EQ(records().size(), 2 * before.size());
  EXPECT_EQ(status()["obsolete"], before.size());
  EXPECT_EQ(status()["finished"], 4);
}

TEST_F(SweepCommand, RetriesFailuresOnlyWhenAsked) {
  write_mesher();
  write_spec({{"inputs", {{{"model", "cube"}, {"edge_length", 1}}}}, {"meshers", {"mesher.json"}}});
  const Outcome first = sweep();
  EXPECT_EQ(first.exit_code, 0) << "the failures of others are results: " << first.err;
  const Json failed = status();
  EXPECT_EQ(failed["cases"], 1) << "it has no lattice";
  EXPECT_EQ(failed["failed"], 1);
  EXPECT_EQ(failed["failures"]["refused"], 1);
  EXPECT_EQ(calls(), 1u);
  ASSERT_EQ(run("mesh out/models/cube-1.poly -o mesh.vtu").exit_code, 0);
  write("works", "");
  EXPECT_EQ(sweep().exit_code, 0);
  EXPECT_EQ(calls(), 1u);
  EXPECT_EQ(sweep("--retry-failed").exit_code, 0);
  EXPECT_EQ(calls(), 2u);
  EXPECT_EQ(status()["finished"], 1) << status();
  EXPECT_EQ(status()["runs"], 1);
}

TEST_F(SweepCommand, KeepsWhatIsFinishedWhenItIsStopped) {
  write_mesher();
  write_spec({{"inputs", {{{"model", "cube"}, {"edge_length", {1, 0.5, 0.34, 0.25, 0.2}}}}},
              {"meshers", {"mesher.json"}},
              {"options", Json::object()}});
  const pid_t child = start_sweep();
  ASSERT_TRUE(wait_for_records(2));
  EXPECT_EQ(sweep().exit_code, 3) << "two sweeps in one folder at the same time";
  kill(child, SIGTERM);
  int ended = 0;
  waitpid(child, &ended, 0);
  ASSERT_TRUE(WIFEXITED(ended));
  EXPECT_EQ(WEXITSTATUS(ended), 128 + SIGTERM);
  const auto before = records();
  EXPECT_LT(before.size(), 5u);
  for (const auto& [name, text] : before) EXPECT_TRUE(Json::accept(text)) << name;
  ASSERT_EQ(sweep().exit_code, 0);
  const auto after = records();
  EXPECT_EQ(after.size(), 5u);
  for (const auto& [name, text] : before) EXPECT_EQ(after.at(name), text);
}

TEST_F(SweepCommand, EstimatesWithoutWriting) {
  write_spec({{"repetitions", 3}});
  const Json estimate = json("--dry-run");
  EXPECT_EQ(estimate["cases"], 4);
  EXPECT_EQ(estimate["missing_runs"], 4 * 4);
  EXPECT_GT(estimate["seconds"], 0);
  EXPECT_GT(estimate["memory_bytes"], 0);
  EXPECT_GT(estimate["disk_bytes"], 0);
  EXPECT_EQ(estimate["finished_cases"], 0);
  EXPECT_FALSE(std::filesystem::exists(work() / "out"));
  ASSERT_EQ(sweep().exit_code, 0);
  EXPECT_EQ(json("--dry-run")["missing_runs"], 0);
  EXPECT_EQ(json("--dry-run")["finished_cases"], 4);
}

TEST_F(SweepCommand, KeepsMeshes) {
  write_spec({{"keep_meshes", true}});
  ASSERT_EQ(sweep().exit_code, 0);
  const Json cases = sweep_json()["cases"];
  for (const Json& one : cases) {
    const std::string mesh = "out/meshes/" + one["id"].get<std::string>() + ".vtu";
    EXPECT_EQ(run("verify out/" + one["input"]["file"].get<std::string>() + " " + mesh).exit_code, 0) << mesh;
  }
}

TEST_F(SweepCommand, RunsCasesBesideEachOtherUnlessTheirTimesMatter) {
  write_spec({{"repetitions", {{"until", 0.1}}}});
  EXPECT_EQ(sweep("--jobs 2").exit_code, 2);
  write_spec();
  EXPECT_EQ(sweep("--jobs 2").exit_code, 0);
  EXPECT_EQ(records().size(), 4u);
  for (const auto& [name, text] : records()) EXPECT_EQ(Json::parse(text)["environment"]["jobs"], 2);
}

TEST_F(SweepCommand, RefusesWrongSpecsBeforeItRunsAnything) {
  write_spec({{"options", {{"lattice", {"fcc", "hcp"}}}}});
  const Outcome outcome = sweep();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("/options/lattice/1"), std::string::npos) << outcome.err;
  for (const char* option : {"report", "output", "mesher", "help", "delauney"}) {
    write_spec({{"options", {{option, "x"}}}});
    EXPECT_EQ(sweep().exit_code, 3) << option;
  }
  EXPECT_FALSE(std::filesystem::exists(work() / "out/runs"));
}

TEST_F(SweepCommand, FindsReadyMadeSweepsByName) {
  std::filesystem::create_directory(work() / "parts");  // is no spec, though it has the name of one
  ASSERT_EQ(run("model cube --edge-length 0.5 -o parts/a.off").exit_code, 0);
  for (const std::string name : {"scaling", "strategies", "parts --input 'parts/*.off'"}) {
    const Outcome outcome = run("sweep " + name + " -o out --dry-run --json");
    ASSERT_EQ(outcome.exit_code, 0) << name << outcome.err;
    EXPECT_GT(Json::parse(outcome.out)["cases"], 0);
  }
}

}  // namespace
}  // namespace ccdt
