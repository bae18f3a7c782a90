#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "tools/tests/experiment_json.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

/// `ccdt reproduce robustness` on a small corpus: two valid parts, one that can be repaired, one that cannot within the
/// limits, and a broken file. Beside ccdt, three meshers misbehave.
class Robustness : public Program {
 protected:
  static constexpr const char* arguments =
      "reproduce robustness -o report --corpus corpus --timeout 3 --beside crashing.json,hanging.json,wrong.json";

  Robustness() {
    std::filesystem::create_directories(work() / "corpus/parts");
    EXPECT_EQ(run("model cube --edge-length 1 -o corpus/parts/cube.off").exit_code, 0);
    EXPECT_EQ(run("model torus --edge-length 0.5 -o corpus/parts/torus.off").exit_code, 0);
    EXPECT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
    EXPECT_EQ(run("mesh sphere.off -o sphere.mesh").exit_code, 0);
    const std::string corners = "OFF\n4 COUNT 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", three = "3 0 2 1\n3 0 1 3\n3 0 3 2\n";
    const auto with_count = [&](const char* count) { return std::string(corners).replace(6, 5, count); };
    write("corpus/parts/twice.off", with_count("5") + three + "3 1 2 3\n3 3 1 2\n");
    write("corpus/parts/open.off", with_count("3") + three);
    write("corpus/parts/broken.off", with_count("9") + three);
    write_manifest({{"cube", {}},
                    {"torus", {}},
                    {"twice", {"duplicate-facets"}},
                    {"open", {"open-edges"}},
                    {"broken", {"unreadable"}}});
    describe("crashing", "kill -SEGV $$");
    describe("hanging", "sleep 100");
    describe("wrong", "cp '" + (work() / "sphere.mesh").string() + "' out.mesh");
  }

  Json result() const { return Json::parse(text_of(work() / "report/robustness.json")); }

  /// The numbers of parts by mesher, input and outcome, without those that are 0.
  std::map<std::string, int> outcomes() const {
    std::map<std::string, int> counts;
    for (const Json& row : rows_of(result(), "outcomes"))
      for (const auto& [name, count] : row["values"].items())
        if (count.is_number() && count > 0 && name != "parts")
          counts[row["values"]["mesher"].get<std::string>() + ", " + row["values"]["input"].get<std::string>() + ", " +
                 name] = count;
    return counts;
  }

 private:
  void write_manifest(const std::vector<std::pair<std::string, std::vector<std::string>>>& parts) const {
    Json files = Json::array();
    for (const auto& [name, faults] : parts)
      files.push_back({{"file", "parts/" + name + ".off"},
                       {"package", "parts"},
                       {"version", "1"},
                       {"path", name + ".off"},
                       {"license", "MIT"},
                       {"sha256", std::string(64, '0')},
                       {"valid", faults.empty()},
                       {"faults", faults}});
    write("corpus/corpus.json", Json({{"schema", "ccdt.corpus/1"},
                                      {"name", "own"},
                                      {"what", "parts"},
                                      {"files", files},
                                      {"left_out", Json::array()}})
                                    .dump());
  }

  void describe(const std::string& name, const std::string& script) const {
    write(name + ".json", Json({{"schema", "ccdt.mesher/1"},
                                {"name", name},
                                {"what", "a mesher"},
                                {"licence", "MIT"},
                                {"command", {"/bin/sh", "-c", script}},
                                {"input_format", "off"},
                                {"output", "out.mesh"}})
                              .dump());
  }
};

TEST_F(Robustness, CountsHowEveryMesherEndsAndGoesOnWhereItWas) {
  const Outcome outcome = run(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const std::map<std::string, int> expected = {
      {"ccdt, valid, right", 2},
      {"ccdt, not valid, invalid_input", 2},
      {"ccdt, unreadable, invalid_input", 1},
      {"ccdt --repair, valid, right", 2},
      {"ccdt --repair, not valid, right", 1},
      {"ccdt --repair, not valid, invalid_input", 1},
      {"ccdt --repair, unreadable, invalid_input", 1},
      {"crashing, valid, crashed", 2},
      {"crashing, not valid, crashed", 2},
      {"crashing, unreadable, invalid_input", 1},
      {"hanging, valid, timeout", 2},
      {"hanging, not valid, timeout", 2},
      {"hanging, unreadable, invalid_input", 1},
      {"wrong, valid, wrong", 2},
      {"wrong, not valid, wrong", 2},
      {"wrong, unreadable, invalid_input", 1},
  };
  EXPECT_EQ(outcomes(), expected);

  const Json tables = result()["tables"];
  const std::string again = result()["command"].get<std::string>().substr(std::string("ccdt ").size());
  std::filesystem::rename(work() / "wrong.json", work() / "gone.json");
  ASSERT_EQ(run_in("report", again).exit_code, 0) << again;
  EXPECT_EQ(result()["tables"], tables) << "no run was repeated, also from the command in the result";
}

TEST_F(Robustness, ListsTheWorstPartsWithCommandsThatRepeatThem) {
  ASSERT_EQ(run(arguments).exit_code, 0);
  std::map<std::string, Json> first;
  for (const Json& row : rows_of(result(), "worst")) first.emplace(row["values"]["mesher"], row["values"]);
  EXPECT_EQ(first.size(), 5u);
  const auto exit_code = [&](const std::string& mesher) {
    const std::string command = first.at(mesher)["command"];
    return run_in("report", command.substr(command.find(' '))).exit_code;
  };
  EXPECT_EQ(first["ccdt"]["outcome"], "right") << "what is not valid may be refused";
  EXPECT_EQ(exit_code("ccdt"), 0);
  EXPECT_EQ(first["ccdt --repair"]["part"], "parts/open.off");
  EXPECT_EQ(exit_code("ccdt --repair"), 3);
  EXPECT_EQ(exit_code("crashing"), 1);
  EXPECT_EQ(first["wrong"]["input"], "valid");
}

TEST_F(Robustness, SaysHowFarARepairMovedAPart) {
  ASSERT_EQ(run(arguments).exit_code, 0);
  const Json rows = rows_of(result(), "displacement");
  ASSERT_EQ(rows.size(), 1u) << rows;
  EXPECT_EQ(rows[0]["values"]["part"], "parts/twice.off");
  EXPECT_LT(rows[0]["values"]["share"], 1e-9);
  EXPECT_NEAR(rows[0]["values"]["area_removed"], 0.866, 0.001) << "one of the two facets";
}

TEST_F(Robustness, NeedsACorpusWithAManifest) {
  EXPECT_EQ(run("reproduce robustness -o report").exit_code, 3);
  EXPECT_EQ(run("reproduce robustness -o report --corpus missing").exit_code, 2);
  std::filesystem::remove(work() / "corpus/corpus.json");
  EXPECT_EQ(run("reproduce robustness -o report --corpus corpus").exit_code, 3);
}

}  // namespace
}  // namespace ccdt
