#include "bench/run/runner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "baselines/external_program.h"
#include "bench/run/json.h"
#include "bench/run/median_interval.h"
#include "bench/run/run_case.h"
#include "engine/base/errors.h"

namespace ccdt::bench {
namespace {

/// Stands for `ccdt mesh`: writes the content of the input as the seconds of its record, or fails if that is not a
/// number; writes an empty mesh, and lists its calls.
constexpr const char* program_text = R"(#!/bin/sh
folder=$(dirname "$0")
echo "$2 $*" >> "$folder/calls"
input=$2
touch "$4"
while [ "$1" != --report ]; do shift; done
number=$(grep -c "^$input " "$folder/calls")
seconds=$(sed -n "$(( (number - 1) % $(wc -l < "$input") + 1 ))p" "$input")
case $seconds in
  [0-9]*) sed "s/\"mesh\": 0.0/\"mesh\": $seconds/" "$folder/record" > "$2" ;;
  crash) kill -SEGV $$ ;;
  *) sed "s/\"status\": \"ok\"/\"status\": \"failed\"/" "$folder/record" > "$2"; exit 1 ;;
esac
)";

class RunnerTest : public testing::Test {
 protected:
  RunnerTest() {
    std::ofstream(program()) << program_text;
    std::filesystem::permissions(program(), std::filesystem::perms::owner_all);
    std::ofstream(folder_.path() / "record") << bench::to_json(RunRecord());
  }

  std::filesystem::path program() const { return folder_.path() / "program"; }

  Case case_of(const std::string& name, const std::string& seconds, Repetitions repetitions = {}) const {
    const auto input = folder_.path() / (name + ".off");
    std::ofstream(input) << seconds;
    return {.name = name, .group = "group", .input = input, .repetitions = repetitions};
  }

  Runner runner(RunnerSettings settings = {}) const {
    settings.program = program();
    settings.folder = folder_.path();
    if (settings.identities.empty()) settings.identities = {{{"ccdt.binary", "now"}}};
    return Runner(settings);
  }

  std::vector<std::string> calls() const {
    std::vector<std::string> inputs;
    std::ifstream file(folder_.path() / "calls");
    for (std::string line; std::getline(file, line);)
      inputs.push_back(std::filesystem::path(line.substr(0, line.find(' '))).stem().string());
    return inputs;
  }

  std::filesystem::path file(const MeasuredCase& measured, int number) const {
    return folder_.path() / run_file(measured.id, number);
  }

  std::size_t records() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_.path() / "runs"), {}));
  }

  baselines::TemporaryFolder folder_;
};

constexpr Repetitions three_after_one = {.warm_up = 1, .at_least = 3, .at_most = 3};

TEST_F(RunnerTest, RunsACaseAsOftenAsItAsks) {
  const MeasuredCase measured = runner().run(case_of("a", "1\n2\n3\n4\n", three_after_one));
  EXPECT_EQ(measured.runs, 4);
  EXPECT_EQ(samples_of(measured, &StageCosts::mesh_seconds), (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(measured.first.costs.mesh_seconds, 1);
  EXPECT_EQ(run_files(measured),
            (std::vector<std::string>{run_file(measured.id, 1), run_file(measured.id, 2), run_file(measured.id, 3)}));
  for (int number = 0; number < 4; ++number) EXPECT_EQ(bench::read_run_record(file(measured, number)).number, number);
  EXPECT_EQ(records(), 4);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "scratch"));
}

TEST_F(RunnerTest, RunsNothingTwice) {
  const Case asked = case_of("a", "1\n", three_after_one);
  runner().run(asked);
  const MeasuredCase again = runner().run(asked);
  EXPECT_EQ(again.counted.size(), 3);
  EXPECT_EQ(calls().size(), 4);
}

TEST_F(RunnerTest, ContinuesWhereItWasStopped) {
  const Case asked = case_of("a", "1\n", three_after_one);
  const MeasuredCase measured = runner().run(asked);
  std::filesystem::remove(file(measured, 2));
  std::filesystem::remove(file(measured, 3));
  EXPECT_EQ(runner().run(asked).counted.size(), 3);
  EXPECT_EQ(calls().size(), 6);
}

TEST_F(RunnerTest, RunsAgainWhatHasATornRecord) {
  const Case asked = case_of("a", "1\n");
  const MeasuredCase measured = runner().run(asked);
  std::filesystem::resize_file(file(measured, 0), 100);
  EXPECT_FALSE(runner().run(asked).failed());
  EXPECT_EQ(calls().size(), 2);
  EXPECT_EQ(bench::read_run_record(file(measured, 0)).status, baselines::RunStatus::ok);
}

TEST_F(RunnerTest, MakesAMeshAgainThatWasNotKeptBefore) {
  Case asked = case_of("a", "1\n");
  runner().run(asked);
  asked.mesh_ending = ".vtu";
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(exists(folder_.path() / mesh_file(runner().run(asked))));
  EXPECT_EQ(calls().size(), 2);
  EXPECT_EQ(records(), 1);
}

TEST_F(RunnerTest, EndsTheRepetitionsOfAFailure) {
  const MeasuredCase measured = runner().run(case_of("a", "1\n1\nno\n1\n", three_after_one));
  EXPECT_TRUE(measured.failed());
  EXPECT_EQ(run_files(measured), std::vector{run_file(measured.id, 2)});
  EXPECT_EQ(measured.counted.size(), 1) << "neither the warm-up nor the failure";
  EXPECT_EQ(calls().size(), 3);
}

TEST_F(RunnerTest, NeitherKeepsNorVerifiesTheMeshOfAFailure) {
  Case asked = case_of("a", "no\n");
  asked.mesh_ending = ".vtu";
  asked.verify = true;
  const MeasuredCase measured = runner().run(asked);
  EXPECT_TRUE(measured.failed());
  EXPECT_FALSE(exists(folder_.path() / mesh_file(measured)));
  EXPECT_EQ(calls().size(), 1);
}

TEST_F(RunnerTest, AsksForOneThreadUnlessACaseSaysHowMany) {
  Case asked = case_of("a", "1\n");
  const auto threads = [&] {
    const std::vector<std::string> words = mesh_arguments(folder_.path(), asked, "mesh.vtu", "report.json");
    const auto found = std::ranges::find(words, "--threads");
    EXPECT_EQ(std::ranges::count(words, "--threads"), 1);
    return found == words.end() ? "" : *std::next(found);
  };
  EXPECT_EQ(threads(), "1");
  asked.options = {"--threads", "3"};
  EXPECT_EQ(threads(), "3");
}

TEST_F(RunnerTest, RecordsACrash) {
  const MeasuredCase measured = runner().run(case_of("a", "crash\n"));
  EXPECT_EQ(measured.first.status, baselines::RunStatus::crashed);
  EXPECT_EQ(measured.first.mesher.name, "ccdt");
  EXPECT_EQ(bench::read_run_record(file(measured, 0)).status, baselines::RunStatus::crashed);
}

TEST_F(RunnerTest, RetriesFailuresOnlyOnRequest) {
  const std::vector all = {case_of("good", "1\n"), case_of("bad", "no\n")};
  runner().run(all);
  runner().run(all);
  EXPECT_EQ(calls().size(), 2);
  Runner retrying = runner({.retry_failed = true});
  retrying.run(all);
  retrying.run(all);
  EXPECT_EQ(calls(), (std::vector<std::string>{calls()[0], calls()[1], "bad"}));
}

TEST_F(RunnerTest, TakesTurnsWithinAGroup) {
  const std::vector all = {case_of("a", "1\n", three_after_one), case_of("b", "2\n", three_after_one),
                           case_of("c", "3\n", three_after_one)};
  runner({.seed = 7}).run(all);
  const std::vector<std::string> order = calls();
  ASSERT_EQ(order.size(), 12);
  std::set<std::vector<std::string>> orders;
  for (std::size_t round = 0; round < 4; ++round) {
    std::vector<std::string> names(order.begin() + 3 * static_cast<long>(round),
                                   order.begin() + 3 * static_cast<long>(round) + 3);
    orders.insert(names);
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c"}));
  }
  EXPECT_GT(orders.size(), 1) << "the order should not be the same in every round";
}

TEST_F(RunnerTest, LetsThoseWithFewerRunsCatchUp) {
  const Case first = case_of("a", "1\n", {.at_least = 2, .at_most = 2});
  runner().run(first);
  constexpr Repetitions four = {.at_least = 4, .at_most = 4};
  runner().run(std::vector{case_of("a", "1\n", four), case_of("b", "2\n", four)});
  const std::vector<std::string> order = calls();
  ASSERT_EQ(order.size(), 8);
  EXPECT_EQ(std::vector(order.begin() + 2, order.begin() + 4), (std::vector<std::string>{"b", "b"}));
}

TEST_F(RunnerTest, TheOrderDependsOnTheSeed) {
  const std::vector all = {case_of("a", "1\n"), case_of("b", "2\n"), case_of("c", "3\n")};
  std::set<std::vector<std::string>> orders;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    std::filesystem::remove_all(folder_.path() / "runs");
    std::filesystem::remove(folder_.path() / "calls");
    runner({.seed = seed}).run(all);
    orders.insert(calls());
  }
  EXPECT_GT(orders.size(), 2);
}

TEST_F(RunnerTest, RunsEqualCasesOnce) {
  const std::vector<MeasuredCase> measured = runner().run(std::vector{case_of("a", "1\n"), case_of("b", "1\n")});
  EXPECT_EQ(measured[0].id, measured[1].id);
  EXPECT_EQ(measured[1].asked.name, "b");
  EXPECT_EQ(measured[1].runs, 1);
  EXPECT_EQ(calls().size(), 1);
}

TEST_F(RunnerTest, RepeatsUntilTheIntervalIsNarrow) {
  constexpr Repetitions until = {.at_least = 6, .at_most = 20, .until = 0.1};
  const std::vector all = {case_of("even", "1\n", until), case_of("wide", "1\n2\n3\n", until)};
  Runner one = runner();
  const std::vector<MeasuredCase> measured = one.run(all);
  EXPECT_EQ(one.uncertain_cases(), std::set<std::string>{"wide"});
  EXPECT_EQ(measured[0].counted.size(), 6);
  EXPECT_EQ(measured[1].counted.size(), 20);
  EXPECT_GT(bench::relative_spread(median_of(measured[1], &StageCosts::mesh_seconds)), 0.1);
}

TEST_F(RunnerTest, CountsSixRunsBeforeItStops) {
  const MeasuredCase measured = runner().run(case_of("a", "1\n", {.at_least = 2, .at_most = 20, .until = 0.1}));
  EXPECT_EQ(measured.counted.size(), 6);
}

TEST_F(RunnerTest, SpendsNoMoreThanTheBudgetOnMoreThanTheLeastNumberOfRuns) {
  const Repetitions budget = {.at_least = 6, .at_most = 100, .until = 0.1, .budget_seconds = 40};
  const std::vector all = {case_of("short", "1\n2\n", budget), case_of("long", "10\n20\n", budget)};
  const std::vector<MeasuredCase> measured = runner().run(all);
  EXPECT_EQ(measured[0].counted.size(), 18) << "54 runs would take 81 s";
  EXPECT_EQ(measured[1].counted.size(), 6);
}

TEST(RunsLeft, AreNoneAsSoonAsTheIntervalIsAsNarrowAsAskedFor) {
  Repetitions repetitions = {.at_least = 6, .at_most = 60, .until = 1};
  const std::vector<double> samples = {1, 1.1, 1.2, 1.3, 1.4, 1.5};
  const double spread = bench::relative_spread(bench::median_estimate(samples, looks_of(repetitions)));
  for (const double share : {0.6, 0.99, 1.01}) {
    repetitions.until = share * spread;
    EXPECT_EQ(are_enough(repetitions, samples, 1), share > 1) << share;
  }
}

TEST(RunsLeft, AreThoseUntilTheNextLookAndTheLast) {
  MeasuredCase measured;
  measured.asked.repetitions = {.warm_up = 1, .at_least = 6, .at_most = 60, .until = 0.01};
  RunRecord record;
  const auto expect_left = [&](int least, int most) {
    EXPECT_EQ(runs_left(measured).least, least) << measured.runs;
    EXPECT_EQ(runs_left(measured).most, most) << measured.runs;
  };
  const auto run_until = [&](int runs) {
    while (measured.runs < runs) {
      record.costs.mesh_seconds = 1 + measured.runs % 3;
      add_run(measured, record);
    }
  };
  expect_left(7, 61);
  run_until(2);
  expect_left(5, 59);
  run_until(7);
  expect_left(12, 54);
  run_until(61);
  expect_left(0, 0);
}

TEST_F(RunnerTest, SeveralJobsMakeTheSameRecords) {
  std::vector<Case> all;
  for (int i = 0; i < 20; ++i) all.push_back(case_of("case" + std::to_string(i), std::to_string(i + 1) + "\n"));
  const std::vector<MeasuredCase> measured = runner({.jobs = 4}).run(all);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(samples_of(measured[static_cast<std::size_t>(i)], &StageCosts::mesh_seconds),
              std::vector<double>{i + 1.0});
  EXPECT_EQ(records(), 20);
}

TEST_F(RunnerTest, ARunWithoutAReportHasItsOptionsAsAnyOther) {
  Case asked = case_of("a", "crash\n");
  asked.options = {"--face-protection", "off", "--edge-length", "0.5", "--strategies", "paper", "--lattice", "bcc"};
  const RunRecord record = runner().run(asked).first;
  EXPECT_EQ(record.kind, baselines::FailureKind::crashed);
  const std::map<std::string, RunRecord::Option> options(record.options.begin(), record.options.end());
  EXPECT_EQ(options.at("face_protection"), RunRecord::Option(false));
  EXPECT_EQ(options.at("edge_length"), RunRecord::Option(0.5));
  EXPECT_EQ(options.at("locator"), RunRecord::Option(std::string("grid")));
  EXPECT_EQ(options.at("lattice"), RunRecord::Option(std::string("bcc")));
  EXPECT_EQ(options.at("threads"), RunRecord::Option(1.0));
  EXPECT_FALSE(options.contains("strategies"));
}

TEST_F(RunnerTest, AnIdChangesWithAllThatDeterminesTheResult) {
  const Case asked = case_of("a", "1\n");
  const Identity now = {{"ccdt.binary", "x"}, {"ccdt.version", "1"}, {"machine.cpu", "fast"}};
  std::set<std::string> ids;
  const auto add = [&](Case other, const Identity& identity) {
    FileHashes hashes;
    ids.insert(id_of(other, identity, hashes));
  };
  add(asked, now);
  Case same = asked;
  same.name = "other", same.group = "other", same.mesh_ending = ".mesh", same.repetitions = three_after_one;
  add(same, {{"ccdt.binary", "x"}, {"ccdt.version", "1"}, {"machine.cpu", "fast"}, {"tetgen.version", "2"}});
  EXPECT_EQ(ids.size(), 1);
  Case options = asked, limits = asked, verified = asked;
  options.options = {"--lattice", "bcc"};
  limits.limits.seconds = 5;
  verified.verify = true;
  for (const Case& other : {options, limits, verified, case_of("b", "2\n")}) add(other, now);
  for (const auto& [field, value] : now) {
    Identity other = now;
    other[field] += "'";
    add(asked, other);
  }
  EXPECT_EQ(ids.size(), 8);
}

TEST_F(RunnerTest, AFileThatWasWrittenAnewMakesAnotherCase) {
  Runner one = runner();
  const std::string before = one.run(case_of("a", "1\n")).id;
  EXPECT_NE(one.run(case_of("a", "22\n")).id, before);
}

class IdentitiesTest : public testing::Test {
 protected:
  const Identity a_ = {{"machine.cpu", "A"}, {"ccdt.version", "1"}}, b_ = {{"machine.cpu", "B"}, {"ccdt.version", "1"}};

  std::vector<Identity> accept(const Identity& now, OtherIdentity policy) {
    const auto accepted = accepted_identities(file(), now, policy);
    bench::write_json(identities_json(accepted), file());
    return accepted;
  }

  std::filesystem::path file() const { return folder_.path() / "identity.json"; }

 private:
  baselines::TemporaryFolder folder_;
};

TEST_F(IdentitiesTest, ADifferenceIsRefusedAndNamed) {
  EXPECT_EQ(accept(a_, OtherIdentity::refuse), std::vector{a_});
  EXPECT_EQ(accept(a_, OtherIdentity::refuse), std::vector{a_});
  try {
    accept(b_, OtherIdentity::refuse);
    FAIL() << "should have been refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("machine.cpu"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("ccdt.version"), std::string::npos);
  }
}

TEST_F(IdentitiesTest, RefreshForgetsTheOld) {
  accept(a_, OtherIdentity::refuse);
  EXPECT_EQ(accept(b_, OtherIdentity::refresh), std::vector{b_});
  EXPECT_EQ(accept(b_, OtherIdentity::refuse), std::vector{b_});
}

TEST_F(IdentitiesTest, RefreshForgetsFilesThatADescriptionNoLongerNames) {
  accept({{"ccdt.version", "1"}, {"mine.file mesh.sh", "x"}, {"mine.version", "1"}}, OtherIdentity::refuse);
  const Identity all = {{"ccdt.version", "1"}, {"mine.version", "2"}};
  EXPECT_EQ(accept({{"mine.version", "2"}}, OtherIdentity::refresh), std::vector{all});
}

TEST_F(IdentitiesTest, MixedKeepsBothAndTakesEitherLater) {
  accept(a_, OtherIdentity::refuse);
  EXPECT_EQ(accept(b_, OtherIdentity::mixed), (std::vector{b_, a_}));
  EXPECT_EQ(accept(b_, OtherIdentity::refuse), (std::vector{b_, a_}));
  EXPECT_EQ(accept(a_, OtherIdentity::refuse).front(), a_);
}

TEST_F(IdentitiesTest, AnAdditionalMesherIsNoDifference) {
  accept(a_, OtherIdentity::refuse);
  Identity more = a_;
  more["tetgen.version"] = "1.6";
  EXPECT_EQ(accept(more, OtherIdentity::refuse), std::vector{more});
  EXPECT_EQ(accept(a_, OtherIdentity::refuse), std::vector{more});
}

TEST_F(RunnerTest, MixedRecordsOfAnotherBinaryCount) {
  const Identity then = {{"ccdt.binary", "then"}}, now = {{"ccdt.binary", "now"}};
  const Case asked = case_of("a", "1\n");
  runner({.identities = {then}}).run(asked);
  runner({.identities = {now, then}}).run(asked);
  EXPECT_EQ(calls().size(), 1);
  runner({.identities = {now}}).run(asked);
  EXPECT_EQ(calls().size(), 2);
}

TEST_F(RunnerTest, MixedRecordsCountOnlyIfTheyAreAllThere) {
  const Identity then = {{"ccdt.binary", "then"}}, now = {{"ccdt.binary", "now"}};
  runner({.identities = {then}}).run(case_of("a", "1\n"));
  const Case more = case_of("a", "1\n", {.at_least = 3, .at_most = 3});
  const MeasuredCase measured = runner({.identities = {now, then}}).run(more);
  EXPECT_EQ(calls().size(), 1 + 3);
  FileHashes hashes;
  EXPECT_EQ(measured.id, id_of(more, now, hashes));
}

TEST_F(RunnerTest, MixedRecordsOfThisBinaryComeFirst) {
  const Identity then = {{"ccdt.binary", "then"}}, now = {{"ccdt.binary", "now"}};
  const Case more = case_of("a", "1\n", {.at_least = 3, .at_most = 3});
  runner({.identities = {then}}).run(more);
  runner({.identities = {now}}).run(case_of("a", "1\n"));
  const MeasuredCase measured = runner({.identities = {now, then}}).run(more);
  EXPECT_EQ(calls().size(), 3 + 1 + 2);
  FileHashes hashes;
  EXPECT_EQ(measured.id, id_of(more, now, hashes));
}

}  // namespace
}  // namespace ccdt::bench
