#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

TEST_F(Program, ReproducesTable1AtACoarseScale) {
  // Mesh_3 needs seconds for the smallest features of the models, however coarse they are.
  const bool with_tetgen = run("mesh --help").out.find("  tetgen ") != std::string::npos;
  const Outcome outcome =
      run(std::string("reproduce table1 -o report --scale 4") + (with_tetgen ? " --beside tetgen" : ""));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("602.25"), std::string::npos) << outcome.out;

  const Json table = Json::parse(text_of(work() / "report/table1.json"));
  EXPECT_EQ(table["schema"], "ccdt.table1/1");
  ASSERT_EQ(table["models"].size(), 3u);
  for (const Json& model : table["models"]) {
    EXPECT_EQ(model["same_tetrahedra"], true);
    for (const Json& row : model["rows"]) {
      if (row["status"] != "ok") continue;
      EXPECT_EQ(row["samples"].size(), 5u) << row;
      EXPECT_LE(row["seconds"]["low"], row["seconds"]["median"]) << row;
      EXPECT_GE(row["seconds"]["high"], row["seconds"]["median"]) << row;
    }
    const std::string record = "report/runs/" + model["name"].get<std::string>() + "-with_check-5.json";
    EXPECT_EQ(Json::parse(text_of(work() / record))["schema"], "ccdt.run/1");
  }
  EXPECT_NE(text_of(work() / "report/table1.md").find("| ratios"), std::string::npos);
}

TEST_F(Program, ReproducesFig8AtACoarseScale) {
  const Outcome outcome = run("reproduce fig8 -o report --scale 5 --models stepping-pole");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("Is it linear?"), std::string::npos) << outcome.out;
  const Json fig8 = Json::parse(text_of(work() / "report/fig8.json"));
  EXPECT_EQ(fig8["schema"], "ccdt.fig8/1");
  ASSERT_EQ(fig8["models"].size(), 1u);
  std::size_t runs = 0;
  for (const Json& series : fig8["models"][0]["series"]) {
    const Json& points = series["points"];
    ASSERT_GE(points.size(), 3u);
    EXPECT_GT(points.back()["counts"]["vertices"], points.front()["counts"]["vertices"]);
    for (const Json& point : points) runs += point["samples"].size();
    EXPECT_EQ(series["fits"].size(), series["id"] == "without_check" ? 3u : 2u) << series;
  }
  std::istringstream csv(text_of(work() / "report/fig8.csv"));
  std::size_t lines = 0;
  for (std::string line; std::getline(csv, line);) ++lines;
  EXPECT_EQ(lines, runs + 1);
  EXPECT_TRUE(std::filesystem::is_empty(work() / "report/meshes"));
}

TEST_F(Program, ReproducesTheLocatorsOnSolidsAndOnAFile) {
  ASSERT_EQ(run("model torus --edge-length 0.3 -o torus.off").exit_code, 0);
  const Outcome outcome =
      run("reproduce locators -o report --scale 6 --models bracket,graded-cube,rough-sphere --input torus.off");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("factor of 181"), std::string::npos) << outcome.out;
  const Json locators = Json::parse(text_of(work() / "report/locators.json"));
  EXPECT_EQ(locators["schema"], "ccdt.locators/1");
  ASSERT_EQ(locators["cases"].size(), 6u);  // the last two with the check off and on
  for (const Json& c : locators["cases"]) {
    ASSERT_EQ(c["rows"].size(), 3u);
    for (const Json& row : c["rows"]) EXPECT_EQ(row["samples"].size(), 5u);
    EXPECT_GT(c["counts"]["front_tetrahedra"], c["kind"] == "input" && c["face_protection"] ? -1 : 0) << c;
  }
}

TEST_F(Program, ReproducesTheInteriorPointsOfASolidAndAFile) {
  ASSERT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
  const Outcome outcome =
      run("reproduce interior-points -o report --scale 2 --models schoenhardt,cube --input sphere.off");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json points = Json::parse(text_of(work() / "report/interior-points.json"));
  EXPECT_EQ(points["schema"], "ccdt.interior-points/1");
  std::set<std::string> inputs;
  for (const Json& c : points["cases"]) inputs.insert(c["input"].get<std::string>());
  EXPECT_EQ(inputs, (std::set<std::string>{"schoenhardt", "cube", "sphere.off"}));
  for (const Json& sums : points["summary"]) EXPECT_GT(sums["placed"], 0) << sums;
  EXPECT_NE(text_of(work() / "report/interior-points.md").find("What this says"), std::string::npos);
}

TEST_F(Program, ReproduceRefusesModelsThatAnExperimentDoesNotHave) {
  const Outcome outcome = run("reproduce fig8 -o report --models cube");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("fig8"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ccdt
