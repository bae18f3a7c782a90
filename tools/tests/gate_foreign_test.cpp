#include "tools/tests/gate_recordings.h"

// Recordings of other programs.

namespace ccdt {
namespace {

Json google_benchmark(int cells, double rate) {
  return {{"context", {{"executable", "./bench_x"}, {"num_cpus", 2}}},
          {"benchmarks",
           {{{"name", "BM_Insert/8"},
             {"run_type", "iteration"},
             {"iterations", 10},
             {"real_time", 12.5},
             {"cpu_time", 12.5},
             {"time_unit", "ms"},
             {"cells", cells},
             {"speed", rate},
             {"items_per_second", 3.0}},
            {{"name", "BM_Insert/8_mean"},
             {"run_type", "aggregate"},
             {"iterations", 1},
             {"real_time", 99.0},
             {"cpu_time", 99.0},
             {"time_unit", "ms"},
             {"cells", cells + 7}}}}};
}

TEST_F(Gate, CountersOfGoogleBenchmarkAreExactAndTimesAreNotJudged) {
  write("base.json", google_benchmark(100, 1.5).dump());
  write("head.json", google_benchmark(101, 1.7).dump());
  EXPECT_EQ(run("gate base.json --against base.json").exit_code, 0);
  EXPECT_EQ(run("gate head.json --against base.json -o out").exit_code, 1);
  EXPECT_EQ(verdict().at("counts").at("worse"), 1);
  EXPECT_EQ(figure(verdict(), "counters.cells").at("verdict"), "worse");
  EXPECT_EQ(figure(verdict(), "seconds.real_time").at("base"), 0.0125);
  EXPECT_EQ(figure(verdict(), "seconds.real_time").at("verdict"), "incomparable");
  EXPECT_EQ(figure(verdict(), "counters.speed").at("verdict"), "incomparable");
  EXPECT_FALSE(figure(verdict(), "counters.speed").at("gated"));
}

TEST_F(Gate, ACounterThatIsWholeInTheBaseIsGatedWhateverTheHeadSays) {
  for (const auto& [speed, exit_code] : {std::pair(18.0, 1), std::pair(18.5, 1), std::pair(12.0, 0)}) {
    write("base.json", google_benchmark(100, 12).dump());
    write("head.json", google_benchmark(100, speed).dump());
    EXPECT_EQ(run("gate head.json --against base.json").exit_code, exit_code) << speed;
  }
}

TEST_F(Gate, OtherCountersAreGatedByARule) {
  write("base.json", google_benchmark(100, 1.5).dump());
  write("head.json", google_benchmark(100, 1.3).dump());
  EXPECT_EQ(run("gate head.json --against base.json").exit_code, 0);
  const auto with = [&](const std::string& rules) {
    write("rules.json", R"({"schema": "ccdt.rules/1", "exact": )" + rules + "}");
    return run("gate head.json --against base.json --rules rules.json").exit_code;
  };
  EXPECT_EQ(with(R"({"better": {"counters.speed": "more"}})"), 1);
  EXPECT_EQ(with(R"({"better": {"counters.speed": "fewer"}})"), 0);
  EXPECT_EQ(with(R"({"better": {"counters.speed": "more"}, "tolerances": {"counters.speed": 0.2}})"), 0);
}

TEST_F(Gate, ACounterThatIsNotANumberIsNamedAndTheOthersAreJudged) {
  const auto with = [](const std::string& speed, int cells) {
    std::string text = google_benchmark(cells, 1.5).dump();
    text.replace(text.find("1.5"), 3, speed);
    return text;
  };
  write("base.json", with("NaN", 100));
  write("head.json", with("NaN", 100));
  const Outcome same = run("gate head.json --against base.json -o out");
  EXPECT_EQ(same.exit_code, 0);
  EXPECT_FALSE(figure(verdict(), "counters.speed").at("gated"));
  EXPECT_NE(same.out.find("counters.speed"), std::string::npos);
  write("head.json", with("-Infinity", 101));
  EXPECT_EQ(run("gate head.json --against base.json -o out").exit_code, 1);
  EXPECT_EQ(figure(verdict(), "counters.cells").at("verdict"), "worse");
  EXPECT_EQ(figure(verdict(), "counters.speed").at("head"), "-Infinity");
}

TEST_F(Gate, AggregatesAloneAreReadByTheirMedian) {
  const auto with = [](int cells) {
    Json recording = google_benchmark(cells, 1.5);
    recording["benchmarks"].erase(0);
    recording["benchmarks"][0]["cells"] = cells + 7;  // the mean
    Json median = recording["benchmarks"][0];
    median["name"] = "BM_Insert/8_median";
    median["aggregate_name"] = "median";
    median["run_name"] = "BM_Insert/8";
    median["cells"] = cells;
    recording["benchmarks"].push_back(median);
    return recording.dump();
  };
  write("base.json", with(100));
  write("head.json", with(101));
  EXPECT_EQ(run("gate base.json --against base.json").exit_code, 0);
  EXPECT_EQ(run("gate head.json --against base.json -o out").exit_code, 1);
  EXPECT_EQ(figure(verdict(), "counters.cells").at("case"), "BM_Insert/8");
  EXPECT_EQ(figure(verdict(), "counters.cells").at("head"), 101);
}

TEST_F(Gate, ANumberTooLargeForAnyDoubleIsAnErrorAndNoVerdict) {
  std::string text = google_benchmark(100, 1.5).dump();
  text.replace(text.find("1.5"), 3, "1e999");
  write("base.json", google_benchmark(100, 1.5).dump());
  write("head.json", text);
  const Outcome outcome = run("gate head.json --against base.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("head.json"), std::string::npos);
  write("rules.json", R"({"schema": "ccdt.rules/1", "time": {"relative": 1e999}})");
  EXPECT_EQ(run("gate base.json --against base.json --rules rules.json").exit_code, 3);
}

TEST_F(Gate, ALostCaseMayBeMissingIfTheRulesSaySo) {
  for (const char* name : {"a.off", "b.off"}) write_run("two", name);
  write_run("one", "a.off");
  write("rules.json", R"({"schema": "ccdt.rules/1", "may_be_missing": ["b.off*"]})");
  EXPECT_EQ(run("gate one --against two --rules rules.json -o out").exit_code, 0);
  EXPECT_EQ(figure(verdict(), "case").at("case"), "b.off, ccdt") << "it is listed all the same";
  write("rules.json", R"({"schema": "ccdt.rules/1", "may_be_missing": ["c*"]})");
  EXPECT_EQ(run("gate one --against two --rules rules.json").exit_code, 1);
}

TEST_F(Gate, TheFirstGateSaysHowToMakeABaseline) {
  write_run("head", "a.off");
  const Outcome outcome = run("gate head --against baseline.json");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("--update --reason"), std::string::npos);
  EXPECT_NE(outcome.err.find("baseline.json"), std::string::npos);
}

TEST_F(Gate, EveryVerdictEndsWithATableOfAllCases) {
  write_pair(change_nothing);
  write_run("base", "b.off");
  write_run("head", "b.off");
  const Outcome outcome = run("gate head --against base --markdown summary.md");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& text : {outcome.out, text_of(work() / "summary.md")})
    for (const char* name : {"a.off, ccdt", "b.off, ccdt", "seconds.mesh"})
      EXPECT_NE(text.find(name), std::string::npos) << name;
}

TEST_F(Gate, GoogleBenchmarksThatOnlyHaveTimesAreNotComparable) {
  Json recording = google_benchmark(1, 1.5);
  recording["benchmarks"][0].erase("cells");
  write("base.json", recording.dump());
  EXPECT_EQ(run("gate base.json --against base.json").exit_code, 3);
}

Json command(const std::string& name, double seconds, int exit_code = 0) {
  Json one = {{"command", name}, {"times", Json::array()}, {"exit_codes", Json::array()}};
  for (int i = 0; i < 10; ++i) {
    one["times"].push_back(seconds * (1 + 0.0001 * (i % 3)));
    one["exit_codes"].push_back(exit_code);
  }
  return one;
}

TEST_F(Gate, TimesOfHyperfineAreNeverJudgedAndTheCommandInTurnsIsShown) {
  // One call, then two. It runs all of the first command before the second, so drift looks like a difference.
  write("both.json", Json{{"results", {command("old/run x", 1), command("new/run x", 1.1)}}}.dump());
  write("old.json", Json{{"results", {command("old/run x", 1)}}}.dump());
  write("new.json", Json{{"results", {command("new/run x", 8)}}}.dump());
  for (const char* call : {"gate both.json -o out", "gate new.json --against old.json -o out"}) {
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.exit_code, 3) << call;
    EXPECT_FALSE(figure(verdict(), "seconds.elapsed").at("gated"));
    EXPECT_NE(outcome.out.find("--base 'old/run x' --head 'new/run x'"), std::string::npos) << outcome.out;
  }
  write("failing.json", Json{{"results", {command("new/run", 2, 1)}}}.dump());
  EXPECT_EQ(run("gate failing.json --against old.json").exit_code, 1);
}

TEST_F(Gate, ARecordingOfTimesIsNoBaseline) {
  write("old.json", Json{{"results", {command("old/run", 1)}}}.dump());
  EXPECT_EQ(run("gate old.json --against baseline.json --update --reason first").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(work() / "baseline.json"));
  // One that was made in another way gates nothing, and does not pass.
  write("baseline.json", R"({"schema": "ccdt.baseline/1", "identity": {}, "history": [],
                             "cases": {"old/run": {"mesh": {"exit_codes": "0"}}}})");
  EXPECT_EQ(run("gate old.json --against baseline.json").exit_code, 3);
}

TEST_F(Gate, ABrokenRecordingIsNamedWithThePlace) {
  write_run("base", "a.off");
  write("broken.json", "{\n\"schema\": \"ccdt.run/1\",\n\"counts\": {,}\n}");
  const Outcome outcome = run("gate broken.json --against base");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("broken.json:3:"), std::string::npos);
  for (const char* text : {"{}", "[1, 2]", "3", R"({"schema": "ccdt.run/1"})", R"({"benchmarks": [{}], "context": {}})",
                           R"({"results": [{"command": 3}]})"}) {
    write("other.json", text);
    const Outcome other = run("gate other.json --against base");
    EXPECT_EQ(other.exit_code, 3) << text;
    EXPECT_NE(other.err.find("other.json"), std::string::npos) << text << other.err;
  }
  EXPECT_EQ(run("gate nothing.json --against base").exit_code, 3);
  std::filesystem::create_directory(work() / "empty");
  EXPECT_EQ(run("gate empty --against base").exit_code, 3);
}

}  // namespace
}  // namespace ccdt
