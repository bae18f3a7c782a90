#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "baselines/external_program.h"
#include "bench/gate/measure_times.h"
#include "bench/tests/fake_targets.h"

namespace ccdt::gate {
namespace {

Outcome gate_of_two(double factor, std::uint64_t seed) {
  return gate({target("a", factor, 2 * seed), target("b", factor, 2 * seed + 1)}, seed);
}

TEST(TimeLayer, UnchangedProgramsPassThoughTheirNoiseHasHeavyTailsAndLasts) {
  int worse = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) worse += gate_of_two(1, seed).verdict() == Judgment::worse;
  EXPECT_EQ(worse, 0);
}

TEST(TimeLayer, FindsFivePercentInNearlyAllGatesAndThreeInMost) {
  int five = 0, three = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    five += gate_of_two(1.05, seed).verdict() == Judgment::worse;
    three += gate_of_two(1.03, seed).verdict() == Judgment::worse;
  }
  EXPECT_GE(five, 99);
  EXPECT_GE(three, 90);
}

TEST(TimeLayer, OnlyTheCaseThatIsSlowerFails) {
  std::vector<TimedTarget> targets;
  for (int i = 0; i < 10; ++i) targets.push_back(target("case " + std::to_string(i), i == 3 ? 1.06 : 1, 50 + i));
  const Outcome outcome = gate(targets, 1);
  for (const JudgedFigure& judged : outcome.figures)
    EXPECT_EQ(judged.verdict, judged.case_name == "case 3" ? Judgment::worse : Judgment::passed) << judged.case_name;
  const JudgedFigure& worse = outcome.of("case 3");
  EXPECT_NEAR(*worse.ratio, 1.06, 0.02);
  EXPECT_LT(worse.interval->low, 1.06);
  EXPECT_GT(worse.interval->high, 1.06);
  EXPECT_GT(worse.interval->low, 1.01);
  EXPECT_GT(*worse.head, *worse.base);
  EXPECT_EQ(worse.name, "seconds.mesh");
  EXPECT_EQ(worse.layer, Layer::time);
  EXPECT_EQ(worse.command, "head case 3");
  EXPECT_TRUE(worse.changed);
}

TEST(TimeLayer, FasterProgramsPassAndAreSeen) {
  const Outcome outcome = gate_of_two(0.9, 1);
  EXPECT_EQ(outcome.verdict(), Judgment::passed);
  EXPECT_TRUE(outcome.of("a").changed);
  EXPECT_LT(outcome.of("a").interval->high, 0.95);
}

TEST(TimeLayer, BothThresholdsCount) {
  Rules relative, absolute;
  relative.time.relative = 0.2;
  absolute.time.absolute_seconds = 0.006;  // of 0.03
  for (const Rules& rules : {relative, absolute}) {
    EXPECT_EQ(gate({target("a", 1.1, 1)}, 1, rules).verdict(), Judgment::passed);
    EXPECT_EQ(gate({target("a", 1.3, 1)}, 1, rules).verdict(), Judgment::worse);
  }
}

TEST(TimeLayer, TooMuchNoiseIsUndecidedAndSaysHowMuch) {
  Rules rules;
  rules.time.at_most = 40;
  const Outcome outcome = gate({target("noisy", 1, 1, 0.5), target("quiet", 1, 2)}, 1, rules);
  EXPECT_EQ(outcome.of("noisy").verdict, Judgment::undecided);
  EXPECT_EQ(outcome.of("quiet").verdict, Judgment::passed);
  EXPECT_EQ(outcome.verdict(), Judgment::undecided);
  EXPECT_EQ(outcome.samples.cases.front().screening.size(), 40U);
  EXPECT_TRUE(outcome.samples.cases.front().confirmation.empty()) << "only what looks worse is measured again";
  EXPECT_NE(outcome.of("noisy").words.find('%'), std::string::npos);
}

TEST(TimeLayer, ASlowdownThatDoesNotComeBackPasses) {
  // Slow as long as the screening lasts: one warm-up and 20 pairs.
  auto runs = std::make_shared<int>(0);
  TimedTarget fake = target("a", 1, 1);
  fake.run = [run = fake.run, runs](const RunRequest& request) {
    auto seconds = run(request);
    const bool is_slow = request.side == Side::head && *runs < 42;
    ++*runs;
    seconds.begin()->second.seconds *= is_slow ? 1.2 : 1;
    return seconds;
  };
  const Outcome outcome = gate({fake}, 1);
  EXPECT_GE(outcome.samples.cases.front().confirmation.size(), 20U);
  EXPECT_EQ(outcome.verdict(), Judgment::passed);
}

TEST(TimeLayer, OrderIsRandomInEachPairAndPaddingInEachRun) {
  std::vector<RunRequest> requests;
  TimedTarget fake = target("a", 1, 1);
  fake.run = [run = fake.run, &requests](const RunRequest& request) {
    requests.push_back(request);
    return run(request);
  };
  Rules rules;
  rules.time.at_least = rules.time.at_most = 100;
  const Outcome outcome = gate({fake}, 7, rules);
  ASSERT_EQ(requests.size(), 2U + 200U);
  std::set<std::size_t> paddings;
  int head_first = 0;
  for (std::size_t i = 0; i < requests.size(); i += 2) {
    EXPECT_NE(requests[i].side, requests[i + 1].side);
    head_first += requests[i].side == Side::head;
    for (const RunRequest& request : {requests[i], requests[i + 1]}) {
      EXPECT_LT(request.padding, 4096U);
      paddings.insert(request.padding);
    }
  }
  EXPECT_GT(head_first, 30);
  EXPECT_LT(head_first, 70);
  EXPECT_GT(paddings.size(), 150U);
  const auto& pairs = outcome.samples.cases.front().screening;
  EXPECT_EQ(pairs.front().head_first, requests[2].side == Side::head);
}

TEST(TimeLayer, CasesTakeTurns) {
  std::string order;
  const auto noted = [&](const std::string& name) {
    TimedTarget fake = target(name, 1, 1, 0.2);
    fake.run = [run = fake.run, &order, name](const RunRequest& request) {
      if (order.empty() || order.back() != name[0]) order += name;
      return run(request);
    };
    return fake;
  };
  gate({noted("a"), noted("b")}, 1);
  EXPECT_GE(order.size(), 6U);
}

TEST(TimeLayer, VerdictsFollowFromTheSamplesOnFile) {
  const baselines::TemporaryFolder folder;
  const Outcome outcome = gate({target("a", 1.05, 1), target("b", 1, 2)}, 3);
  write_samples(outcome.samples, folder.path() / "samples.json");
  const SampleSet read = read_samples(folder.path() / "samples.json");
  EXPECT_EQ(read.seed, outcome.samples.seed);
  EXPECT_EQ(read.cases.front().screening, outcome.samples.cases.front().screening);
  const auto again = judge_times(read, {}, nullptr);
  ASSERT_EQ(again.size(), outcome.figures.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(again[i].verdict, outcome.figures[i].verdict);
    EXPECT_EQ(again[i].interval, outcome.figures[i].interval);
    EXPECT_EQ(again[i].words, outcome.figures[i].words);
  }
}

TEST(TimeLayer, AMissingCaseIsWorseUnlessTheRulesAllowItAndANewOneIsOnlyListed) {
  TimedTarget fake = {"two", "real_time"};
  fake.run = [](const RunRequest& request) {
    return measured({{"both", 1}, {request.side == Side::head ? "new" : "old", 1}});
  };
  fake.command = [](Side, const std::string& name) { return name; };
  const Outcome outcome = gate({fake}, 1);
  EXPECT_EQ(outcome.of("both").verdict, Judgment::passed);
  EXPECT_EQ(outcome.of("old").verdict, Judgment::worse);
  EXPECT_EQ(outcome.of("new").verdict, Judgment::passed);
  EXPECT_FALSE(outcome.of("new").is_gated);
  Rules rules;
  rules.may_be_missing = {"ol*"};
  EXPECT_EQ(gate({fake}, 1, rules).verdict(), Judgment::passed);
  EXPECT_EQ(gate({fake}, 1, rules).figures.size(), 3U) << "it is listed all the same";
}

TEST(TimeLayer, OnlyCasesThatTheRulesNameAreTimed) {
  Rules rules;
  rules.time.cases = {"a*"};
  EXPECT_EQ(gate({target("ab", 1, 1), target("b", 1, 2)}, 1, rules).figures.size(), 1U);
}

TEST(TimeLayer, ANoiseFloorOfACalibrationRaisesTheThreshold) {
  Calibration calibration;
  calibration.cases.emplace_back();
  calibration.cases.back().case_name = "a";
  calibration.cases.back().noise_floor = 0.2;
  SampleSet samples = start_samples(1);
  measure_times(std::vector{target("a", 1.06, 1)}, {}, {}, samples);
  EXPECT_EQ(judgment_of(judge_times(samples, {}, nullptr)), Judgment::worse);
  EXPECT_EQ(judgment_of(judge_times(samples, {}, &calibration)), Judgment::passed);
}

TEST(TimeLayer, PassingExcludesASlowdownBeyondTheLimit) {
  // Programs that are slower by just the limit: however often the gate looks, few pass.
  Rules rules;
  int passed = 0;
  constexpr int gates = 300;
  const double at_limit = 1 + rules.time.relative + rules.time.largest_noise;
  for (std::uint64_t seed = 0; seed < gates; ++seed)
    passed += gate({target("a", at_limit, 1000 + seed, 0.04)}, seed, rules).verdict() == Judgment::passed;
  EXPECT_LE(bench::share_of(passed, gates).low, 0.05);
}

TEST(TimeLayer, TenTimesSlowerNeverPassesAtAnyTimePerIteration) {
  for (const double seconds : {1e-12, 1e-9, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 10.0})
    for (const double absolute : {0.0, 0.0002, 1.0}) {
      TimedTarget fake = {"bench", "real_time"};
      fake.run = [=](const RunRequest& request) {
        return measured({{"a", seconds * (request.side == Side::head ? 10 : 1)}});
      };
      fake.command = [](Side, const std::string&) { return ""; };
      Rules rules;
      rules.time.absolute_seconds = absolute;
      SampleSet samples = start_samples(1);
      samples.clock_seconds = 2e-8;
      measure_times(std::vector{fake}, rules, {}, samples);
      const Judgment verdict = judgment_of(judge_times(samples, rules, nullptr));
      EXPECT_TRUE(verdict == Judgment::worse || verdict == Judgment::undecided)
          << seconds << " s, absolute " << absolute;
      if (absolute == 0 && seconds >= 1e-8) {
        EXPECT_EQ(verdict, Judgment::worse) << seconds;
      }
    }
}

TEST(TimeLayer, AProgramThatFailsDoesNotHideOtherCases) {
  TimedTarget fake = {"bench", "real_time"};
  const std::vector<std::string> all = {"base crashes", "both crash", "good", "head crashes"};
  fake.list = [=](Side) { return all; };
  fake.command = [](Side side, const std::string& name) { return std::string(name_of(side)) + " " + name; };
  fake.run = [=](const RunRequest& request) {
    Measured result;
    const std::string side(name_of(request.side));
    for (const std::string& name : all) {
      if (!request.cases.empty() && !request.cases.contains(name)) continue;
      if (name.starts_with(side) || name.starts_with("both"))
        throw ProgramFailed(request.side, "SIGSEGV in " + name, {}, "");
      result.merge(measured({{name, 1}}));
    }
    return result;
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Outcome outcome = gate({fake}, seed);
    EXPECT_EQ(outcome.figures.size(), 4U);
    EXPECT_EQ(outcome.of("good").verdict, Judgment::passed);
    EXPECT_EQ(outcome.of("head crashes").verdict, Judgment::worse);
    EXPECT_EQ(outcome.of("base crashes").verdict, Judgment::incomparable);
    EXPECT_EQ(outcome.of("both crash").verdict, Judgment::incomparable);
    EXPECT_NE(outcome.of("both crash").words.find("SIGSEGV"), std::string::npos);
    EXPECT_EQ(outcome.verdict(), Judgment::worse);
  }
}

TEST(TimeLayer, ACrashAfterGoodRunsIsOneRow) {
  auto runs = std::make_shared<int>(0);
  TimedTarget fake = {"bench", "real_time"};
  fake.command = [](Side, const std::string&) { return ""; };
  fake.run = [=](const RunRequest& request) {
    Measured result;
    for (const std::string name : {"good", "late"}) {
      if (!request.cases.empty() && !request.cases.contains(name)) continue;
      if (name == "late" && request.side == Side::head && ++*runs > 10) throw ProgramFailed(Side::head, "late", {}, "");
      result.merge(measured({{name, 1}}));
    }
    return result;
  };
  const Outcome outcome = gate({fake}, 1);
  EXPECT_EQ(outcome.of("late").verdict, Judgment::worse);
  EXPECT_EQ(outcome.of("good").verdict, Judgment::passed);
}

TEST(TimeLayer, ACaseThatDoesNotComeBackIsNotWaitedFor) {
  TimedTarget fake = {"bench", "real_time"};
  fake.command = [](Side, const std::string&) { return ""; };
  fake.run = [](const RunRequest& request) {
    return request.cases.empty() || request.side == Side::base ? measured({{"good", 1}, {"shy", 1}})
                                                               : measured({{"good", 1}});
  };
  const Outcome outcome = gate({fake}, 1);
  EXPECT_EQ(outcome.of("shy").verdict, Judgment::worse);
  EXPECT_EQ(outcome.of("good").verdict, Judgment::passed);
}

TEST(TimeLayer, TheHeadMayTakeManyTimesAsLongAsTheBaseButNotForEver) {
  std::map<Side, double> limits;
  TimedTarget fake = target("a", 1, 1);
  fake.run = [run = fake.run, &limits](const RunRequest& request) {
    limits[request.side] = request.most_seconds;
    return run(request);
  };
  gate({fake}, 1);
  EXPECT_GE(limits.at(Side::head), 10);
  EXPECT_LT(limits.at(Side::head), 60);
}

TEST(TimeLayer, AStoppedGateGoesOnWhereItWas) {
  int runs = 0;
  TimedTarget fake = target("a", 1, 1);
  fake.run = [run = fake.run, &runs](const RunRequest& request) {
    if (++runs == 20) throw baselines::Stopped();
    return run(request);
  };
  SampleSet samples = start_samples(1);
  EXPECT_THROW(measure_times(std::vector{fake}, {}, {}, samples), baselines::Stopped);
  const std::size_t kept = samples.cases.front().screening.size();
  EXPECT_EQ(kept, 8U);
  EXPECT_FALSE(samples.is_finished);
  const auto first = samples.cases.front().screening;
  measure_times(std::vector{fake}, {}, {}, samples);
  EXPECT_TRUE(samples.is_finished);
  EXPECT_GE(samples.cases.front().screening.size(), 20U);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), samples.cases.front().screening.begin()));
}

TEST(TimeLayer, AStoppedGateStillTakesAsManyPairsAsTheRulesDemand) {
  TimedTarget fake = {"a", "seconds.mesh"};
  fake.run = [](const RunRequest&) { return measured({{"a", 1}}); };
  fake.command = [](Side, const std::string&) { return ""; };
  SampleSet samples = start_samples(1);
  samples.cases.push_back(case_without_times("a"));
  samples.cases.front().screening.assign(8, {1, 1});  // equal times: with these alone the case would be decided
  measure_times(std::vector{fake}, {}, {}, samples);
  EXPECT_EQ(samples.cases.front().screening.size(), 20U);
}

TEST(TimeLayer, AConfirmationEndsAtAWidthThatIsFixedInAdvance) {
  const Outcome outcome = gate({target("a", 1.3, 1, 0.06)}, 1);
  const PairedSamples& one = outcome.samples.cases.front();
  ASSERT_LT(one.confirmation.size(), 200U);
  const Look first = screen(one, outcome.samples, {}, nullptr);
  const Look second = confirm(one, first, 1, {}, outcome.samples.seed);
  EXPECT_LE(half_width(second.log_ratio), wanted_half_width(first, {}))
      << "a confirmation that ends when it agrees would agree too often";
}

TEST(TimeLayer, ProgressHasATotalAndEndsAtIt) {
  TimeProgress last;
  SampleSet samples = start_samples(3);
  const MeasureOptions options = {.progress = [&](const TimeProgress& now) {
    EXPECT_GE(now.expected, now.pairs);
    EXPECT_GE(now.pairs, last.pairs);
    last = now;
  }};
  measure_times(std::vector{target("a", 1, 1), target("b", 1.2, 2)}, {}, options, samples);
  EXPECT_EQ(last.cases, 2U);
  EXPECT_EQ(last.expected, last.pairs);
}

}  // namespace
}  // namespace ccdt::gate
