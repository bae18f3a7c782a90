#include <nlohmann/json.hpp>

#include "baselines/json_schema.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

using Json = nlohmann::json;

constexpr const char* corners_of_cube = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";
constexpr const char* bottom = "3 0 2 1\n3 1 2 3\n";
constexpr const char* sides = "3 0 1 4\n3 1 5 4\n3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";
constexpr const char* top = "3 4 5 6\n3 5 7 6\n";

class CheckCommand : public Program {
 protected:
  void write_cube(const std::string& name, int facets, const std::string& triangles) const {
    write(name, "OFF\n8 " + std::to_string(facets) + " 0\n" + corners_of_cube + triangles);
  }
  Json report() const { return Json::parse(text_of(work() / "report.json")); }
};

TEST_F(CheckCommand, AcceptsAValidSurface) {
  write_cube("cube.off", 12, std::string(bottom) + sides + top);
  EXPECT_EQ(run("check cube.off --report report.json").exit_code, 0);
  EXPECT_EQ(report()["valid"], true);
  EXPECT_EQ(report()["faults"], Json::array());
  EXPECT_EQ(report()["volume"], 1);
}

TEST_F(CheckCommand, ListsAllFaultsOfABrokenSurface) {
  write_cube("open.off", 12, std::string(bottom) + sides + "3 4 5 6\n3 0 2 1\n");
  const Outcome outcome = run("check open.off --report report.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err, "");
  ASSERT_EQ(report()["faults"].size(), 2u);
  EXPECT_EQ(report()["faults"][0]["kind"], "duplicate-facets");
  EXPECT_EQ(report()["faults"][0]["places"][0]["facets"], Json({0, 11}));
  EXPECT_EQ(report()["faults"][1]["kind"], "open-edges");
  EXPECT_EQ(report()["faults"][1]["places"][0]["points"].size(), 3u);
  EXPECT_EQ(run("mesh open.off -o open.vtu").exit_code, 3);
}

TEST_F(CheckCommand, WritesARepairedCopyThatCanBeMeshed) {
  write_cube("open.off", 10, std::string(bottom) + sides);
  for (const char* extension : {"stl", "off", "obj", "ply", "poly", "smesh", "mesh", "meshb"}) {
    const std::string copy = std::string("copy.") + extension;
    EXPECT_EQ(run("check open.off --repair --limit 1 -o " + copy + " --report report.json").exit_code, 0) << copy;
    EXPECT_EQ(report()["valid"], false);
    EXPECT_EQ(report()["copy"]["valid"], true) << copy;
    EXPECT_EQ(report()["copy"]["volume"], 1) << copy;
    EXPECT_EQ(run("mesh " + copy + " -o copy.vtu --lattice none").exit_code, 0) << copy;
    EXPECT_EQ(run("verify " + copy + " copy.vtu").exit_code, 0) << copy;
  }
}

TEST_F(CheckCommand, RefusesALidThatReachesTooFarAndNamesTheOptionThatAllowsIt) {
  write_cube("open.off", 10, std::string(bottom) + sides);
  const Outcome outcome = run("check open.off --repair -o copy.off --report report.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(work() / "copy.off"));
  const Json copy = report()["copy"];
  EXPECT_TRUE(copy["output"].is_null());
  ASSERT_EQ(copy["refused"].size(), 1u);
  const std::string refusal = copy["refused"][0];
  const std::size_t begin = refusal.find("--limit ");
  const std::string limit = refusal.substr(begin, refusal.rfind(" allows it") - begin);
  EXPECT_EQ(run("check open.off --repair -o copy.off " + limit).exit_code, 0) << limit;
}

TEST_F(CheckCommand, SaysHowFarItCameInTheGivenTime) {
  write_cube("open.off", 10, std::string(bottom) + sides);
  EXPECT_EQ(run("check open.off --repair -o copy.off --time 1e-9 --report report.json").exit_code, 4);
  EXPECT_EQ(report()["copy"]["out_of_time"], true);
  EXPECT_TRUE(std::filesystem::exists(work() / "copy.off"));
}

TEST_F(CheckCommand, MeshRepairsAndKeepsTheSurfaceForVerify) {
  write_cube("covered.off", 13, std::string(bottom) + sides + top + "3 4 5 7\n");
  EXPECT_EQ(run("mesh covered.off -o covered.vtu").exit_code, 3);
  ASSERT_EQ(run("mesh covered.off -o covered.vtu --repair --surface-output s.off --report report.json").exit_code, 0);
  EXPECT_EQ(run("verify s.off covered.vtu").exit_code, 0);
  EXPECT_EQ(report()["repaired"]["displacement"], 0);
  EXPECT_NEAR(report()["repaired"]["area_removed"].get<double>(), 0.5, 1e-9);
}

TEST_F(CheckCommand, ReportMatchesItsSchema) {
  write_cube("open.off", 10, std::string(bottom) + sides);
  ASSERT_EQ(run("check open.off --repair --limit 1 -o copy.off --report report.json").exit_code, 0);
  const std::string schema = text_of(CHECK_SCHEMA);
  EXPECT_NO_THROW(baselines::read_user_file(work() / "report.json", {"a report", schema.c_str(), ""}));
}

TEST_F(CheckCommand, SheetsThatEncloseNothingHaveNoCopy) {
  write("sheet.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 0\n4 1 0\n3 0 1 2\n3 0 3 4\n");
  EXPECT_EQ(run("check sheet.off --repair -o copy.off").exit_code, 3);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(CheckCommand, CopyThatIsStillBrokenIsWrittenAndExitsWithThree) {
  // The seed of a region is outside of everything, and no repair moves it.
  write_cube("cube.off", 12, std::string(bottom) + sides + top);
  ASSERT_EQ(run("check cube.off --repair -o cube.poly").exit_code, 0);
  const std::string poly = text_of(work() / "cube.poly");
  write("seed.poly", poly.substr(0, poly.rfind("0")) + "1\n0 5 5 5\n0\n");
  EXPECT_EQ(run("check seed.poly --repair -o copy.poly").exit_code, 3);
  EXPECT_TRUE(std::filesystem::exists(work() / "copy.poly"));
}

TEST_F(CheckCommand, FileThatCannotBeReadIsAnErrorMessage) {
  write("broken.off", "OFF\n8 12 0\n0 0 0\n");
  const Outcome outcome = run("check broken.off --report report.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("broken.off"), std::string::npos);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(CheckCommand, RefusesWrongUsage) {
  write_cube("cube.off", 12, std::string(bottom) + sides + top);
  for (const char* arguments :
       {"check", "check cube.off --repair", "check cube.off -o copy.off", "check cube.off --gap 1",
        "check cube.off --limit 1", "check cube.off --time 1", "check cube.off --repair -o copy.off --gap 0"})
    EXPECT_EQ(run(arguments).exit_code, 2) << arguments;
  EXPECT_EQ(run("check cube.off --repair -o cube.off").exit_code, 3);
  EXPECT_EQ(file_count(), 1u);
}

}  // namespace
}  // namespace ccdt
