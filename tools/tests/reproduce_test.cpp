#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace ccdt
