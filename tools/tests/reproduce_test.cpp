#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tools/tests/experiment_json.h"
#include "tools/tests/program.h"

namespace ccdt {
namespace {

TEST_F(Program, ReproducesTable1AtACoarseScale) {
  // Mesh_3 needs seconds for the smallest features of the models, however coarse they are.
  const bool with_tetgen = run("mesh --help").out.find("  tetgen ") != std::string::npos;
  const Outcome outcome =
      run(std::string("reproduce table1 -o report --scale 2000") + (with_tetgen ? " --beside tetgen" : ""));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("602.2"), std::string::npos) << outcome.out;

  const Json table = Json::parse(text_of(work() / "report/table1.json"));
  EXPECT_EQ(table["schema"], "ccdt.experiment/1");
  EXPECT_EQ(table["command"],
            std::string("ccdt reproduce table1 --scale 2000") + (with_tetgen ? " --beside tetgen" : "") + " -o .");
  for (const Json& row : rows_of(table, "sizes")) EXPECT_EQ(row["values"]["same_tetrahedra"], "yes");
  EXPECT_EQ(rows_of(table, "sizes").size(), 3u);
  for (const Json& row : rows_of(table, "times")) {
    if (row["values"]["status"] != "ok") continue;
    const Json& seconds = row["values"]["seconds"];
    EXPECT_GE(row["runs"].size(), 3u) << row;
    EXPECT_LE(seconds["low"], seconds["value"]) << row;
    EXPECT_GE(seconds["high"], seconds["value"]) << row;
    for (const Json& file : row["runs"])
      EXPECT_EQ(Json::parse(text_of(work() / "report" / file.get<std::string>()))["schema"], "ccdt.run/1");
  }
  EXPECT_NE(text_of(work() / "report/table1.md").find("## Ratios"), std::string::npos);
}

/// A part of Table 1 that takes a second or two.
class InterruptedTable1 : public Program {
 protected:
  static constexpr const char* arguments = "reproduce table1 -o report --scale 500 --models piston --beside ccdt";

  /// Calls the program, and sends it a signal as soon as there are this many records.
  /// \return  as of waitpid
  int call_until(std::size_t records, int signal) const {
    const std::string command = "cd '" + work().string() + "' && exec '" CCDT_PROGRAM "' " + arguments;
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", (command + " >../out 2>../err").c_str(), nullptr);
      _exit(127);
    }
    int status = 0;
    bool is_sent = false;
    while (waitpid(child, &status, WNOHANG) == 0)
      if (!is_sent && times_of_records().size() >= records) is_sent = kill(child, signal) == 0;
    return status;
  }

  /// When each record was written.
  std::map<std::string, std::filesystem::file_time_type> times_of_records() const {
    std::map<std::string, std::filesystem::file_time_type> times;
    if (!std::filesystem::exists(work() / "report/runs")) return times;
    for (const auto& entry : std::filesystem::directory_iterator(work() / "report/runs"))
      if (entry.path().extension() == ".json") times[entry.path().filename()] = entry.last_write_time();
    return times;
  }

  /// Do all of these records still exist unchanged?
  void expect_kept(const std::map<std::string, std::filesystem::file_time_type>& before) const {
    const auto now = times_of_records();
    for (const auto& [file, time] : before) {
      ASSERT_TRUE(now.contains(file)) << file;
      EXPECT_EQ(now.at(file), time) << file;
    }
  }
};

TEST_F(InterruptedTable1, GoesOnWhereItWasAndRunsNothingTwice) {
  const int killed = call_until(3, SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(killed));
  EXPECT_FALSE(std::filesystem::exists(work() / "report/table1.json"));
  const auto first = times_of_records();
  const int stopped = call_until(first.size() + 3, SIGTERM);
  ASSERT_TRUE(WIFEXITED(stopped));
  EXPECT_EQ(WEXITSTATUS(stopped), 128 + SIGTERM);
  expect_kept(first);
  const auto second = times_of_records();
  EXPECT_GT(second.size(), first.size());

  ASSERT_EQ(run(arguments).exit_code, 0);
  expect_kept(second);
  const auto all = times_of_records();
  const Json tables = Json::parse(text_of(work() / "report/table1.json"))["tables"];
  ASSERT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(times_of_records(), all);
  EXPECT_EQ(Json::parse(text_of(work() / "report/table1.json"))["tables"], tables);

  ASSERT_EQ(run("reproduce table1 -o undisturbed --scale 500 --models piston --beside ccdt").exit_code, 0);
  ASSERT_EQ(run("report undisturbed report -o difference").exit_code, 0);
  const Json comparison = Json::parse(text_of(work() / "difference/report.json"))["experiments"][0];
  EXPECT_TRUE(rows_of(comparison, "differences").empty()) << comparison;
  EXPECT_GT(rows_of(comparison, "summary")[0]["values"]["figures"], 0);
  EXPECT_EQ(rows_of(comparison, "summary")[0]["values"]["unmatched"], 0);
}

TEST_F(Program, ReproducesFig8AtACoarseScale) {
  const Outcome outcome = run("reproduce fig8 -o report --scale 4000 --models bracket --beside ccdt");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json fig8 = Json::parse(text_of(work() / "report/fig8.json"));
  std::map<std::string, std::vector<double>> sizes;
  for (const Json& row : rows_of(fig8, "points")) sizes[row["values"]["strategy"]].push_back(row["values"]["vertices"]);
  EXPECT_EQ(sizes.size(), 4u);
  for (const auto& [strategy, vertices] : sizes) {
    ASSERT_GE(vertices.size(), 3u) << strategy;
    EXPECT_TRUE(std::ranges::is_sorted(vertices)) << strategy;
  }
  std::map<std::string, int> fits, work_fits;
  for (const Json& row : rows_of(fig8, "fits")) ++fits[row["values"]["strategy"]];
  EXPECT_EQ(fits["paper, with check"], 2);
  EXPECT_EQ(fits["paper, without check"], 3);
  EXPECT_EQ(fits["Delaunay refinement, ours"], 1);
  for (const Json& row : rows_of(fig8, "work")) {
    ++work_fits[row["values"]["strategy"]];
    EXPECT_EQ(row["values"]["judged"], "no") << "the range is too short: " << row;
  }
  EXPECT_EQ(work_fits["paper, without check"], 6);
  EXPECT_EQ(rows_of(fig8, "lines").size(), 2 * sizes.size());
}

TEST_F(Program, ReproducesTheLocatorsOnSolidsAndOnAFile) {
  ASSERT_EQ(run("model torus --edge-length 0.3 -o torus.off").exit_code, 0);
  const Outcome outcome =
      run("reproduce locators -o report --scale 1000 --models bracket,graded-cube,rough-sphere --input torus.off");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json locators = Json::parse(text_of(work() / "report/locators.json"));
  EXPECT_EQ(rows_of(locators, "sizes").size(), 6u);  // the last two with the check off and on
  EXPECT_EQ(rows_of(locators, "front").size(), 6 * 3u);
  for (const Json& row : rows_of(locators, "front")) {
    EXPECT_GE(row["runs"].size(), 3u);
    EXPECT_GT(row["values"]["front_tetrahedra"], row["values"]["face_protection"] == "off" ? 0 : -1) << row;
  }
}

TEST_F(Program, ReproducesTheInteriorPointsOfASolidAndAFile) {
  ASSERT_EQ(run("model sphere --edge-length 0.5 -o sphere.off").exit_code, 0);
  const Outcome outcome =
      run("reproduce interior-points -o report --scale 10000 --models schoenhardt,cube --input sphere.off");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json points = Json::parse(text_of(work() / "report/interior-points.json"));
  std::set<std::string> inputs;
  for (const Json& row : rows_of(points, "cases")) inputs.insert(row["values"]["model"].get<std::string>());
  EXPECT_EQ(inputs, (std::set<std::string>{"schoenhardt", "cube", "sphere.off"}));
  for (const Json& row : rows_of(points, "rules")) EXPECT_GT(row["values"]["interior_vertices"], 0) << row;
  EXPECT_FALSE(text_of(work() / "report/interior-points.md").empty());
}

TEST_F(Program, ReproducesTheTerminationOfSplittingWithAllItsSteinerVertices) {
  const Outcome outcome = run("reproduce termination -o report --scale 1000");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Json termination = Json::parse(text_of(work() / "report/termination.json"));
  int wheels = 0;
  for (const Json& row : rows_of(termination, "stars")) {
    const Json& values = row["values"];
    if (values["star"] != "wheel") continue;
    ++wheels;
    // Where midpoints do not end, no spoke is a Delaunay edge at once.
    EXPECT_EQ(values["shell_steiner_vertices"] > 0, values["midpoint_ended"] == 0) << row;
    EXPECT_EQ(values["shell_deepest_level"] > 0, values["midpoint_ended"] == 0) << row;
  }
  EXPECT_GT(wheels, 5);
}

/// Figure 7 alone, which is quick.
class SmallReport : public Program {
 protected:
  SmallReport() { outcome_ = run("reproduce fig7 -o report --scale 1000 --models piston"); }
  Json report() const { return Json::parse(text_of(work() / "report/report.json")); }

  Outcome outcome_;
};

TEST_F(SmallReport, IsMadeFromTheJsonAloneAgainAndAgain) {
  ASSERT_EQ(outcome_.exit_code, 0) << outcome_.out << outcome_.err;
  const std::string before = text_of(work() / "report/report.json");
  for (const char* made :
       {"report/report.json", "report/claims.json", "report/fig7.md", "report/tables/fig7-meshes.csv"})
    ASSERT_TRUE(std::filesystem::remove(work() / made)) << made;
  ASSERT_EQ(run("report report").exit_code, 0);
  EXPECT_EQ(text_of(work() / "report/report.json"), before);
  for (const char* made : {"report/claims.json", "report/fig7.md", "report/tables/fig7-meshes.csv",
                           "report/tables/fig7-meshes.md", "report/tables/fig7-meshes.tex"})
    EXPECT_FALSE(text_of(work() / made).empty()) << made;
}

TEST_F(SmallReport, SaysWhatIsMissing) {
  std::size_t missing = 0;
  const Json sections = report()["experiments"];
  for (const Json& section : sections) {
    if (section["name"] == "fig7") continue;
    ++missing;
    EXPECT_EQ(section["status"], "missing");
    EXPECT_NE(outcome_.out.find(section["command"].get<std::string>()), std::string::npos) << section["command"];
  }
  EXPECT_GE(missing, 9u);
}

TEST_F(SmallReport, HasACommandThatRepeatsEachRun) {
  const Json rows = rows_of(report()["experiments"][1], "meshes");
  const std::string file = rows[0]["runs"][0];
  const std::string command = report()["runs"][file]["command"];
  ASSERT_TRUE(command.starts_with("ccdt mesh ")) << command;
  const Outcome again = run_in("report", command.substr(5));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const Json first = Json::parse(text_of(work() / "report" / file));
  const Json second = Json::parse(text_of(work() / "report/again.json"));
  EXPECT_EQ(first["counts"], second["counts"]);
  EXPECT_EQ(first["quality"], second["quality"]);
  EXPECT_EQ(first["counts"]["tetrahedra"], rows[0]["values"]["tetrahedra"]);
}

TEST_F(SmallReport, RepeatedIsTheSameBitForBit) {
  ASSERT_EQ(run("reproduce fig7 -o again --scale 1000 --models piston").exit_code, 0);
  const Outcome outcome = run("report report again");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json comparison = Json::parse(text_of(work() / "again/comparison/report.json"))["experiments"][0];
  EXPECT_TRUE(rows_of(comparison, "differences").empty()) << comparison;
  EXPECT_GT(rows_of(comparison, "summary")[0]["values"]["figures"], 0);
}

TEST_F(SmallReport, IsNotContinuedByOtherProgramsUnlessThatIsWanted) {
  ASSERT_EQ(outcome_.exit_code, 0) << outcome_.err;
  Json identity = Json::parse(text_of(work() / "report/identity.json"));
  identity["identity"]["ccdt.binary"] = "another";
  write("report/identity.json", identity.dump());
  const std::string arguments = "reproduce fig7 -o report --scale 1000 --models piston";
  const Outcome refused = run(arguments);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("ccdt.binary"), std::string::npos) << refused.err;
  EXPECT_EQ(run(arguments + " --mixed --refresh").exit_code, 2);
  ASSERT_EQ(run(arguments + " --mixed").exit_code, 0);
  const Json mixed = Json::parse(text_of(work() / "report/identity.json"));
  EXPECT_NE(mixed["identity"]["ccdt.binary"], "another");
  EXPECT_EQ(mixed["mixed_with"][0]["ccdt.binary"], "another");
  EXPECT_EQ(run(arguments).exit_code, 0);
}

TEST_F(Program, ReportRefusesAFolderWithoutExperiments) {
  std::filesystem::create_directory(work() / "empty");
  const Outcome outcome = run("report empty");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("ccdt reproduce"), std::string::npos) << outcome.err;
  EXPECT_EQ(run("report nowhere").exit_code, 2);
}

TEST_F(Program, ReproduceRefusesScalesThatAreNone) {
  for (const char* scale : {"tiny", "0", "-5", "nan", "10x"}) {
    const Outcome outcome = run(std::string("reproduce fig7 -o report --scale ") + scale);
    EXPECT_EQ(outcome.exit_code, 2) << scale;
    for (const char* part : {"--scale", scale, "quick", "full", "large"})
      EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
}

TEST_F(Program, ReproduceKnowsTheOlderNameOfTheFullScale) {
  ASSERT_EQ(run("reproduce conditions -o report --scale paper --models cube").exit_code, 0);
  EXPECT_EQ(Json::parse(text_of(work() / "report/conditions.json"))["scale"], "full");
}

TEST_F(Program, ReproduceRefusesModelsThatAnExperimentDoesNotHave) {
  const Outcome outcome = run("reproduce fig8 -o report --models cube");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("fig8"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace ccdt
