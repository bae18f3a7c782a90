#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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
    nlohmann::json json = {{"schema", "ccdt.experiment/1"},
                           {"name", "fig7"},
                           {"title", "Fig. 7"},
                           {"section", "6"},
                           {"command", "ccdt reproduce fig7"},
                           {"scale", "quick"},
                           {"tetrahedra", 8000},
                           {"runs", 1},
                           {"confidence", 0.95},
                           {"limits", {{"seconds", 600}, {"memory_bytes", 0}}},
                           {"good", true},
                           {"definitions", nlohmann::json::array()},
                           {"findings", nlohmann::json::array()},
                           {"problems", nlohmann::json::array()},
                           {"tables", nlohmann::json::array()},
                           {"meshes", nlohmann::json::array()},
                           {"raw_files", nlohmann::json::array()},
                           {"environment", environment()}};
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

TEST_F(StrangeFiles, AReportDoesNotReadThroughLinks) {
  std::filesystem::create_directory(work() / "D");
  write("secret.json", R"({"schema": "ccdt.pagemesh/1", "key": "secret of another folder"})");
  std::filesystem::create_symlink("../secret.json", work() / "D/linked.json");
  write_experiment("D/fig7.json",
                   {{"meshes", {{{"file", "linked.json"}, {"title", ""}, {"run", ""}, {"figure", false}}}}});
  ASSERT_EQ(run("report D").exit_code, 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(work() / "D"))
    EXPECT_TRUE(entry.is_symlink() || text_of(entry.path()).find("secret of another") == std::string::npos)
        << entry.path();
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
