#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/tests/experiment_json.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// Files made by somebody who does not wish us well. They cause an error, and nothing else happens.
class StrangeFiles : public Program {
 protected:
  void expect_refused(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 3) << arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.out + outcome.err, "") << arguments;
  }
  /// An experiment whose members may be replaced.
  void write_experiment(const std::string& file, const nlohmann::json& changes) const {
    Json json = empty_experiment(environment());
    json.update(changes);
    write(file, json.dump());
  }

 private:
  /// The environment of a real run.
  nlohmann::json environment() const {
    if (!std::filesystem::exists(work() / "run.json")) {
      EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
      EXPECT_EQ(run("mesh cube.off -o cube.vtu --report run.json").exit_code, 0);
    }
    return nlohmann::json::parse(text_of(work() / "run.json"))["environment"];
  }
};

TEST_F(StrangeFiles, WithoutATriangle) {
  write("one-vertex.poly", "1 3 0 0\n1 0 0 0\n1 0\n2 0\n3 1 1 1\n2 1 1\n0\n0\n");
  write("flat.poly", "# ccdt inside even_odd\n1 3 0 0\n1 1.5 1e-05 0\n1 1\n2 0 1\n5 1 1 1 1 1\n3 1 1 1\n0\n0\n");
  write("edge.poly", "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 2 0 0\n2 1\n1 0 0\n3 1 2 3\n1 0 0\n2 1 3\n0\n0\n");
  for (const std::string file : {"one-vertex.poly", "flat.poly", "edge.poly"}) {
    expect_refused("mesh " + file + " -o out.vtu");
    expect_refused("check " + file);
    expect_refused("check " + file + " --repair -o copy.poly");
  }
}

TEST_F(StrangeFiles, DeeplyNestedJson) {
  constexpr int deep = 100000;
  const std::string nested = std::string(deep, '[') + std::string(deep, ']');
  std::filesystem::create_directory(work() / "D");
  for (const std::string& text : {nested, R"({"schema": "ccdt.sweep/1", "name": )" + nested + "}",
                                  R"({"schema": "ccdt.experiment/1", "name": )" + nested + "}"}) {
    write("deep.json", text);
    write("D/fig7.json", text);
    expect_refused("sweep deep.json -o out");
    expect_refused("gate deep.json --against deep.json");
    expect_refused("gate cube.off --against cube.off --rules deep.json");
    expect_refused("mesh cube.off -o cube.vtu --mesher deep.json");
    expect_refused("report D");
  }
}

TEST_F(StrangeFiles, LongNamesInRecordsDoNotMultiply) {
  EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  EXPECT_EQ(run("mesh cube.off -o cube.vtu --report run.json").exit_code, 0);
  nlohmann::json record = nlohmann::json::parse(text_of(work() / "run.json"));
  nlohmann::json many = nlohmann::json::object();
  for (int i = 0; i < 2000; ++i) many[std::to_string(i)] = i;
  record["counts"][std::string(100000, 'x')] = many;
  write("run.json", record.dump());
  expect_refused("gate run.json --against run.json");
}

TEST_F(StrangeFiles, AReportStaysInItsFolder) {
  std::filesystem::create_directory(work() / "D");
  std::filesystem::create_directory(work() / "outside");
  write("outside/README.md", "mine");
  write("outside/secret.json", R"({"key": "secret"})");
  const nlohmann::json table = {{"name", "../../outside/README"},
                                {"title", ""},
                                {"data", false},
                                {"columns", nlohmann::json::array()},
                                {"rows", nlohmann::json::array()}};
  const nlohmann::json mesh = {{"file", "../outside/secret.json"}, {"title", ""}, {"run", ""}, {"figure", true}};
  for (const nlohmann::json& changes : std::vector<nlohmann::json>{{{"name", "../outside/README"}},
                                                                   {{"name", (work() / "outside/README").string()}},
                                                                   {{"name", ".."}},
                                                                   {{"tables", {table}}},
                                                                   {{"meshes", {mesh}}},
                                                                   {{"raw_files", {"../outside/secret.json"}}},
                                                                   {{"raw_files", {"/etc/passwd"}}},
                                                                   {{"raw_files", {"javascript:alert(1)"}}}}) {
    SCOPED_TRACE(changes.dump());
    write_experiment("D/fig7.json", changes);
    expect_refused("report D");
    EXPECT_EQ(text_of(work() / "outside/README.md"), "mine");
  }
  write_experiment("D/fig7.json", nlohmann::json::object());
  EXPECT_EQ(run("report D").exit_code, 0) << "without these changes it is right";
}

TEST_F(StrangeFiles, LinksThatLeadOutOfAFolderOfResultsAreRefused) {
  std::filesystem::create_directory(work() / "outside");
  write("outside/precious", "mine");
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "s", "inputs": [{"model": "cube", "edge_length": 1}],
                         "meshers": ["ccdt"], "repetitions": 1})");
  for (const std::string link : {"linked.json", "runs", "scratch", "meshes", "tables", "comparison", "models/a.poly"}) {
    SCOPED_TRACE(link);
    const auto place = work() / "D" / link;
    std::filesystem::create_directories(place.parent_path());
    write_experiment("D/fig7.json", nlohmann::json::object());
    ASSERT_EQ(run("report D").exit_code, 0) << "without the link it is right";
    std::filesystem::remove_all(place);
    std::filesystem::create_symlink(work() / "outside", place);
    for (const char* arguments :
         {"report D", "report D D", "sweep spec.json -o D", "reproduce fig7 -o D", "gate D --against D"})
      expect_refused(arguments);
    std::filesystem::remove_all(work() / "D");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(work() / "outside"), {}), 1);
    EXPECT_EQ(text_of(work() / "outside/precious"), "mine");
  }
}

TEST_F(StrangeFiles, LinksWithinAFolderOfResultsAreFollowed) {
  std::filesystem::create_directories(work() / "D/inner");
  write_experiment("D/inner/fig7.json", nlohmann::json::object());
  std::filesystem::create_symlink("inner/fig7.json", work() / "D/fig7.json");
  EXPECT_EQ(run("report D").exit_code, 0);
}

TEST_F(StrangeFiles, OutputsReplaceLinksInsteadOfWhatTheyNameWouldOverwrite) {
  EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  for (const std::string output : {"o.vtu", "o.node"}) {
    write("precious", "mine");
    std::filesystem::create_symlink("precious", work() / output);
    EXPECT_EQ(run("mesh cube.off -o " + output).exit_code, 0);
    EXPECT_EQ(text_of(work() / "precious"), "mine");
    EXPECT_FALSE(std::filesystem::is_symlink(work() / output));
  }
}

TEST_F(StrangeFiles, PipesAreNotOpened) {
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "s", "inputs": [{"model": "cube", "edge_length": 1}],
                         "meshers": ["ccdt"], "repetitions": 1})");
  ASSERT_EQ(run("sweep spec.json -o S").exit_code, 0);
  ASSERT_EQ(mkfifo((work() / "pipe.off").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((work() / "S/pipe.json").c_str(), 0600), 0);
  expect_refused("mesh pipe.off -o o.vtu");
  expect_refused("verify pipe.off pipe.off");
  expect_refused("gate S/pipe.json --against S");
  nlohmann::json sweep = nlohmann::json::parse(text_of(work() / "S/sweep.json"));
  sweep["mixed_with"] = nlohmann::json::array({sweep["identity"]});
  for (nlohmann::json& one : sweep["cases"]) one["input"]["file"] = (work() / "pipe.off").string();
  write("S/sweep.json", sweep.dump());
  EXPECT_EQ(run("report S").exit_code, 0);
}

TEST_F(StrangeFiles, ReportsRunNoMesherAndOpenNoInput) {
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "s", "inputs": [{"model": "cube", "edge_length": 1}],
                         "meshers": ["ccdt"], "repetitions": 1})");
  ASSERT_EQ(run("sweep spec.json -o S").exit_code, 0);
  write("S/mesher.json", R"({"schema": "ccdt.mesher/1", "name": "m", "what": "a mesher", "licence": "MIT",
                             "version_command": ["/usr/bin/touch", "ran"], "command": ["/usr/bin/touch", "ran"],
                             "input_format": "off", "output": "out.mesh"})");
  nlohmann::json sweep = nlohmann::json::parse(text_of(work() / "S/sweep.json"));
  sweep["mixed_with"] = nlohmann::json::array({sweep["identity"]});
  for (nlohmann::json& one : sweep["cases"]) {
    one["mesher"] = "m";
    one["mesher_file"] = (work() / "S/mesher.json").string();
    one["input"]["file"] = "/no/such/file.off";
  }
  write("S/sweep.json", sweep.dump());
  EXPECT_EQ(run("report S").exit_code, 0);
  run("gate S --against S");
  EXPECT_FALSE(std::filesystem::exists(work() / "ran") || std::filesystem::exists(work() / "S/ran"));
}

TEST_F(StrangeFiles, ManyMembersOfAnObjectAndManyFiguresEndSoon) {  // quadratic time would reach the limit of the test
  std::string members;
  for (int i = 0; i < 1'000'000; ++i) members += (i == 0 ? "\"" : ", \"") + std::to_string(i) + "\": 1";
  write("many.json", "{" + members + "}");
  expect_refused("gate many.json --against many.json");
  expect_refused("sweep many.json -o out");
  EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  EXPECT_EQ(run("mesh cube.off -o cube.vtu --report run.json").exit_code, 0);
  std::string record = text_of(work() / "run.json");
  record.replace(record.find("\"counts\": {"), 11, "\"counts\": {" + members + ", ");
  write("run.json", record);
  expect_refused("gate run.json --against run.json");
}

TEST_F(StrangeFiles, OfEqualNamesTheLastCounts) {
  write("spec.json", R"({"schema": "wrong", "name": "first", "inputs": [{"model": "cube", "edge_length": 1}],
                         "meshers": ["ccdt"], "repetitions": 1, "name": "s", "schema": "ccdt.sweep/1"})");
  ASSERT_EQ(run("sweep spec.json -o D").exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(text_of(work() / "D/sweep.json"))["name"], "s");
}

TEST_F(StrangeFiles, ALockIsNoLink) {
  write("precious", "text");
  write("spec.json", R"({"schema": "ccdt.sweep/1", "name": "s", "inputs": [{"model": "cube", "edge_length": 1}],
                         "meshers": ["ccdt"], "repetitions": 1})");
  std::filesystem::create_directory(work() / "D");
  std::filesystem::create_symlink("../precious", work() / "D/lock");
  expect_refused("sweep spec.json -o D");
  expect_refused("reproduce fig7 -o D");
  EXPECT_EQ(text_of(work() / "precious"), "text");
}

TEST_F(StrangeFiles, NothingFromAFileControlsTheTerminal) {
  const std::string escape = "\033]0;OWNED\033[31m", c1 = "\xC2\x9B"
                                                          "31m";
  EXPECT_EQ(run("model cube --edge-length 1 -o cube.off").exit_code, 0);
  write("strange.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$" + escape + c1 + "RED\n");
  const std::string name = "a" + escape + c1 + ".off";
  std::filesystem::copy_file(work() / "cube.off", work() / name);
  for (const std::string& arguments :
       {std::string("verify cube.off strange.msh"), "mesh '" + name + "' -o out.vtu", "check '" + name + "'",
        "verify '" + name + "' out.vtu", "mesh '" + name + "x' -o out.vtu",
        "mesh '" + name + "' -o '" + name + ".vtu'"}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = run(arguments);
    EXPECT_EQ((outcome.out + outcome.err).find('\033'), std::string::npos);
    EXPECT_EQ((outcome.out + outcome.err).find('\x9B'), std::string::npos);
  }
}

}  // namespace
}  // namespace ccdt
