#include <cmath>

#include "tools/tests/gate_recordings.h"

namespace ccdt {
namespace {

TEST_F(Gate, EqualRecordingsPass) {
  write_pair(change_nothing);
  EXPECT_EQ(run("gate head --against base -o out").exit_code, 0);
  EXPECT_EQ(verdict().at("verdict"), "passed");
  EXPECT_GT(verdict().at("counts").at("passed"), 8);
}

TEST_F(Gate, OneReportIsARecording) {
  write_pair(set("work.delaunay.walk_steps", 1001));
  EXPECT_EQ(run("gate base/a.off.json --against base").exit_code, 0);
  EXPECT_EQ(run("gate head/a.off.json --against base/a.off.json").exit_code, 1);
}

TEST_F(Gate, MoreWorkFailsByItsSizeWithTheCommandThatRepeatsIt) {
  const Json figure = judged("work.delaunay.walk_steps", set("work.delaunay.walk_steps", 1100));
  EXPECT_EQ(figure.at("verdict"), "worse");
  EXPECT_EQ(figure.at("base"), 1000);
  EXPECT_EQ(figure.at("head"), 1100);
  EXPECT_DOUBLE_EQ(figure.at("ratio"), 1.1);
  EXPECT_EQ(figure.at("layer"), "exact");
  EXPECT_EQ(figure.at("case"), "a.off, ccdt");
  EXPECT_NE(figure.at("command").get<std::string>().find("ccdt mesh a.off"), std::string::npos);
}

TEST_F(Gate, WorkWhereThereWasNoneFails) {
  const Json figure = judged("work.delaunay.exact_evaluations", set("work.delaunay.exact_evaluations", 1));
  EXPECT_EQ(figure.at("verdict"), "worse");
  EXPECT_TRUE(figure.at("ratio").is_null());
}

TEST_F(Gate, LessWorkPassesAndIsReported) {
  write_pair(set("work.delaunay.walk_steps", 900));
  const Outcome outcome = run("gate head --against base -o out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(figure(verdict(), "work.delaunay.walk_steps").at("changed"));
  EXPECT_NE(outcome.out.find("work.delaunay.walk_steps"), std::string::npos);
  EXPECT_NE(outcome.out.find("-10"), std::string::npos);
}

TEST_F(Gate, SmallerAnglesFailAndLargerOnesPass) {
  EXPECT_EQ(judged("quality.dihedral_degrees.min", set("quality.dihedral_degrees.min", 20)).at("verdict"), "worse");
  EXPECT_EQ(judged("quality.dihedral_degrees.min", set("quality.dihedral_degrees.min", 21)).at("verdict"), "passed");
}

TEST_F(Gate, WorseRadiusRatiosFailAlsoIfTheyAreInfinite) {
  EXPECT_EQ(judged("quality.r.max", set("quality.r.max", 2.6)).at("verdict"), "worse");
  EXPECT_EQ(judged("quality.r.max", set("quality.r.max", 2.4)).at("verdict"), "passed");
  EXPECT_EQ(judged("quality.r.max", set("quality.r.max", nullptr)).at("verdict"), "worse");
}

TEST_F(Gate, LastBitsOfNumbersThatAreNotWholeDoNotMatter) {
  EXPECT_FALSE(judged("volume", set("volume", std::nextafter(1.25, 2))).at("changed"));
  EXPECT_EQ(judged("volume", set("volume", 1.2501)).at("verdict"), "worse");
}

TEST_F(Gate, AnotherMeshFailsEvenIfItIsSmaller) {
  EXPECT_EQ(judged("mesh_fingerprint", set("mesh_fingerprint", "4567")).at("verdict"), "worse");
  EXPECT_EQ(judged("counts.tetrahedra", set("counts.tetrahedra", 399)).at("verdict"), "worse");
  EXPECT_EQ(judged("counts.splits_by_level", set("counts.splits_by_level", {2})).at("verdict"), "worse");
}

TEST_F(Gate, AFailedRunIsWorseAndAFixedOneBetter) {
  const Change fail = [](Json& run) {
    run["status"] = "crashed";
    run["kind"] = "crashed";
    run["counts"]["vertices"] = 0;
  };
  EXPECT_EQ(judged("status", fail).at("verdict"), "worse");
  EXPECT_EQ(verdict().at("counts").at("worse"), 1);  // the missing results are not counted as more losses
  EXPECT_EQ(run("gate base --against head -o out").exit_code, 3) << "no performance figure can be compared";
  for (const char* folder : {"base", "head"}) write_run(folder, "b.off");
  EXPECT_EQ(run("gate base --against head -o out").exit_code, 0);
  EXPECT_TRUE(figure(verdict(), "status").at("changed"));
}

TEST_F(Gate, ALostCaseFailsAndANewOnePasses) {
  for (const char* name : {"a.off", "b.off"}) write_run("two", name);
  write_run("one", "a.off");
  EXPECT_EQ(run("gate one --against two -o out").exit_code, 1);
  EXPECT_EQ(verdict().at("figures").at(0).at("case"), "b.off, ccdt");
  EXPECT_EQ(run("gate two --against one -o out").exit_code, 0);
}

TEST_F(Gate, ALostFigureFails) {
  write_pair([](Json& run) { run["counts"].erase("vertices"); });
  EXPECT_EQ(run("gate head --against base").exit_code, 1);
  EXPECT_EQ(run("gate base --against head").exit_code, 0);
}

TEST_F(Gate, ACountOfWorkThatIsNotInAReportIsZero) {
  write_pair([](Json& run) { run["work"]["delaunay"].erase("walk_steps"); });
  EXPECT_EQ(run("gate head --against base").exit_code, 0);
  EXPECT_EQ(run("gate base --against head").exit_code, 1);
}

TEST_F(Gate, CasesAreToldApartByTheirOptions) {
  for (const char* folder : {"base", "head"}) {
    write_run(folder, "a.off");
    Json run = run_of("a.off");
    run["options"]["lattice"] = "bcc";
    if (std::string(folder) == "head") run["work"]["delaunay"]["walk_steps"] = 2000;
    write(std::string(folder) + "/bcc.json", run.dump());
  }
  EXPECT_EQ(run("gate head --against base -o out").exit_code, 1);
  EXPECT_EQ(verdict().at("counts").at("worse"), 1);
  EXPECT_EQ(verdict().at("figures").at(0).at("case"), "a.off, ccdt, lattice bcc");
}

TEST_F(Gate, RunsOfOneProgramThatDifferFail) {
  for (const char* folder : {"base", "head"})
    for (const int number : {0, 1}) {
      Json run = run_of("a.off");
      if (std::string(folder) == "head") run["work"]["delaunay"]["walk_steps"] = 1000 - number;
      write_run(folder, "a.off");
      write(std::string(folder) + "/again" + std::to_string(number) + ".json", run.dump());
    }
  EXPECT_EQ(run("gate head --against base -o out").exit_code, 1);
  EXPECT_EQ(run("gate base --against head -o out").exit_code, 3) << "a gated figure was not judged";
  EXPECT_EQ(figure(verdict(), "work.delaunay.walk_steps").at("verdict"), "incomparable");
}

TEST_F(Gate, TheWorstIsFirst) {
  write_pair([](Json& run) {
    run["work"]["delaunay"]["walk_steps"] = 1010;
    run["counts"]["steiner_vertices"] = 8;
    run["quality"]["r"]["max"] = 3;
  });
  run("gate head --against base -o out");
  std::vector<std::string> names;
  for (int i = 0; i < 3; ++i) names.push_back(verdict().at("figures").at(i).at("name"));
  EXPECT_EQ(names, (std::vector<std::string>{"counts.steiner_vertices", "quality.r.max", "work.delaunay.walk_steps"}));
}

TEST_F(Gate, TimesThatWereRecordedEarlierAreNeverJudged) {
  const Json time = judged("seconds.mesh", set("seconds.mesh", 150));
  EXPECT_EQ(time.at("verdict"), "incomparable");
  EXPECT_FALSE(time.at("gated"));
  EXPECT_EQ(verdict().at("verdict"), "passed");
  EXPECT_EQ(run("gate head --against base --layers time").exit_code, 3);
  EXPECT_EQ(run("gate head --against base --layers exact,time -o out").exit_code, 3) << "it was asked for";
  EXPECT_EQ(verdict().at("layers").at(0).at("judged"), true);
  EXPECT_EQ(verdict().at("layers").at(1).at("judged"), false);
}

TEST_F(Gate, RecordingsOfDifferentThingsAreNotComparable) {
  write_run("base", "a.off");
  write_run("head", "b.off");
  EXPECT_EQ(run("gate head --against base -o out").exit_code, 3);
  EXPECT_EQ(verdict().at("verdict"), "incomparable");
  EXPECT_FALSE(verdict().at("notes").empty());
}

TEST_F(Gate, ShadowModePassesAndSaysWhatIsWorse) {
  write_pair(set("counts.steiner_vertices", 5));
  EXPECT_EQ(run("gate head --against base -o out --shadow").exit_code, 0);
  EXPECT_EQ(verdict().at("verdict"), "worse");
  EXPECT_TRUE(verdict().at("shadow"));
}

TEST_F(Gate, MarkdownIsAppendedWithAllThatFailed) {
  write("summary.md", "# Before\n");
  for (int i = 0; i < 60; ++i) {
    const std::string name = "p" + std::to_string(i) + ".off";
    write_run("base", name);
    write_run("head", name, set("counts.steiner_vertices", 5 + i));
  }
  EXPECT_EQ(run("gate head --against base --markdown summary.md").exit_code, 1);
  const std::string text = text_of(work() / "summary.md");
  EXPECT_TRUE(text.starts_with("# Before\n"));
  for (int i = 0; i < 60; ++i)
    EXPECT_NE(text.find("p" + std::to_string(i) + ".off, ccdt"), std::string::npos) << "case " << i;
}

// Baselines.

TEST_F(Gate, AnUpdateNeedsAReason) {
  write_run("head", "a.off");
  for (const char* reason : {"", "--reason ''", "--reason ' '"})
    EXPECT_EQ(run("gate head --against baseline.json --update " + std::string(reason)).exit_code, 2) << reason;
  EXPECT_FALSE(std::filesystem::exists(work() / "baseline.json"));
}

TEST_F(Gate, AfterAnUpdateTheSameRecordingPasses) {
  write_pair(set("counts.steiner_vertices", 5));
  ASSERT_EQ(run("gate base --against baseline.json --update --reason first").exit_code, 0);
  EXPECT_EQ(run("gate base --against baseline.json").exit_code, 0);
  EXPECT_EQ(run("gate head --against baseline.json").exit_code, 1);
  ASSERT_EQ(run("gate head --against baseline.json --update --reason 'a new rule'").exit_code, 0);
  EXPECT_EQ(run("gate head --against baseline.json").exit_code, 0);
  EXPECT_EQ(run("gate base --against baseline.json").exit_code, 0);  // better
}

TEST_F(Gate, ABaselineKeepsTheReasonsAndNoTimes) {
  write_pair(set("counts.steiner_vertices", 5));
  run("gate base --against baseline.json --update --reason first");
  run("gate head --against baseline.json --update --reason second");
  const Json baseline = Json::parse(text_of(work() / "baseline.json"));
  ASSERT_EQ(baseline.at("history").size(), 2u);
  EXPECT_EQ(baseline.at("history").at(1).at("reason"), "second");
  EXPECT_EQ(baseline.at("history").at(1).at("changed"), 1);
  EXPECT_DOUBLE_EQ(baseline.at("history").at(1).at("ratios").at("exact"), 1.25);
  EXPECT_FALSE(baseline.at("cases").at("a.off, ccdt").contains("seconds"));
}

TEST_F(Gate, ABaselineHoldsWhatTheRulesGate) {
  write_run("head", "a.off");
  write("rules.json", R"({"schema": "ccdt.rules/1", "exact": {"figures": ["work.*"], "ignore": ["*.walk_steps"]}})");
  ASSERT_EQ(run("gate head --against baseline.json --rules rules.json --update --reason first").exit_code, 0);
  const Json figures = Json::parse(text_of(work() / "baseline.json")).at("cases").at("a.off, ccdt");
  EXPECT_EQ(figures, Json::parse(R"({"work.delaunay": {"exact_evaluations": 0}})"));
}

TEST_F(Gate, AHistoryThatOnlyGetsWorseIsPointedOut) {
  for (int steps = 1000; steps < 1004; ++steps) {
    write_run("head", "a.off", set("work.delaunay.walk_steps", steps));
    run("gate head --against baseline.json --update --reason 'step " + std::to_string(steps) + "'");
  }
  const Outcome outcome = run("gate head --against baseline.json -o out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(verdict().at("notes").dump().find("step 1003"), std::string::npos);
  EXPECT_NE(outcome.out.find("step 1003"), std::string::npos);
  write_run("head", "a.off", set("work.delaunay.walk_steps", 900));
  run("gate head --against baseline.json --update --reason better");
  run("gate head --against baseline.json -o out");
  EXPECT_EQ(verdict().at("notes").dump().find("step 1003"), std::string::npos);
}

TEST_F(Gate, ABaselineThatIsBrokenIsNamedWithThePlace) {
  write_run("head", "a.off");
  write("baseline.json",
        R"({"schema": "ccdt.baseline/1", "identity": {}, "history": [], "cases": {"a": {"work": 3}}})");
  const Outcome outcome = run("gate head --against baseline.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("baseline.json"), std::string::npos);
  EXPECT_NE(outcome.err.find("/cases/a/work"), std::string::npos);
}

// Instruction counts.

/// A baseline with instruction counts.
std::string with_instructions(const std::string& cpu, long count) {
  const Json json = {{"schema", "ccdt.baseline/1"},
                     {"identity", {{"instructions.cpu", cpu}}},
                     {"cases", {{"a", {{"instructions", {{"mesh", count}}}}}}},
                     {"history", Json::array()}};
  return json.dump();
}

TEST_F(Gate, InstructionsOfTheSameCpuAreComparedBeyondBothThresholds) {
  write("base.json", with_instructions("X", 100000000));
  write("more.json", with_instructions("X", 102000000));
  write("slightly_more.json", with_instructions("X", 100200000));
  EXPECT_EQ(run("gate more.json --against base.json -o out").exit_code, 1);
  EXPECT_EQ(figure(verdict(), "instructions.mesh").at("layer"), "instructions");
  EXPECT_EQ(run("gate slightly_more.json --against base.json").exit_code, 0);
  EXPECT_EQ(run("gate base.json --against more.json").exit_code, 0);
}

TEST_F(Gate, InstructionsOfAnotherCpuAreNotComparable) {
  write("base.json", with_instructions("some CPU", 100000000));
  write("other.json", with_instructions("another CPU", 200000000));
  const Outcome outcome = run("gate other.json --against base.json");
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char* words : {"instructions.cpu", "some CPU", "another CPU"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words;
}

// Rules.

TEST_F(Gate, RulesTolerateIgnoreAndTurnFigures) {
  const auto verdict_with = [&](const std::string& rules) {
    write("rules.json", R"({"schema": "ccdt.rules/1", "exact": )" + rules + "}");
    return judged("work.delaunay.walk_steps", set("work.delaunay.walk_steps", 1100), "--rules rules.json");
  };
  EXPECT_EQ(verdict_with("{}").at("verdict"), "worse");
  EXPECT_EQ(verdict_with(R"({"tolerances": {"work.*": 0.2}})").at("verdict"), "passed");
  EXPECT_EQ(verdict_with(R"({"tolerances": {"work.*": 0.05}})").at("verdict"), "worse");
  EXPECT_EQ(verdict_with(R"({"better": {"work.*": "more"}})").at("verdict"), "passed");
  EXPECT_TRUE(verdict_with(R"({"ignore": ["*walk_steps"]})").is_null());
}

TEST_F(Gate, WrongRulesAreNamedByTheirPointer) {
  write_pair(change_nothing);
  write("rules.json", R"({"schema": "ccdt.rules/1", "time": {"relativ": 0.1}})");
  const Outcome outcome = run("gate head --against base --rules rules.json");
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char* words : {"rules.json", "/time/relativ", "'relative'"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words;
  write("rules.json", R"({"schema": "ccdt.rules/1", "special": [{"cases": "a*", "time": {"at_most": 10}}]})");
  EXPECT_NE(run("gate head --against base --rules rules.json").err.find("/special/0/time/at_most"), std::string::npos);
}

TEST_F(Gate, OptionsThatDoNotFitTogetherAreUsageErrors) {
  write_pair(change_nothing);
  for (const char* options :
       {"", "head", "head base --against base", "head --against base --calibrate", "head --against base --layers all",
        "--head nothing --sweep s.json -o out", "head --against base --reason none"})
    EXPECT_EQ(run("gate " + std::string(options)).exit_code, 2) << options;
}

}  // namespace
}  // namespace ccdt
