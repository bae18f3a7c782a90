#include "bench/gate/time_layer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "baselines/external_program.h"
#include "bench/gate/pair_statistics.h"

namespace ccdt::gate {
namespace {

/// Noise as measured for `ccdt mesh`: mostly 2%, and one run in ten is disturbed.
class FakeProgram {
 public:
  explicit FakeProgram(std::uint64_t seed, double noise = 0.02) : random_(seed), noise_(noise) {}

  double seconds() {
    const double disturbed = unit_(random_) < 0.1 ? 0.2 * unit_(random_) : 0;
    // Disturbances longer than a run: the clock of the processor, other programs.
    drift_ = 0.9 * drift_ + 0.01 * normal_(random_);
    return 0.03 * std::exp(drift_ + noise_ * normal_(random_) + disturbed);
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> unit_;
  double noise_, drift_ = 0;
};

/// A target with one case whose head takes this many times as long.
TimedTarget target(const std::string& name, double factor, std::uint64_t seed, double noise = 0.02) {
  TimedTarget fake = {name, "seconds.mesh"};
  fake.run = [=, program = std::make_shared<FakeProgram>(seed, noise)](const RunRequest& request) {
    return std::map<std::string, double>{{name, program->seconds() * (request.side == Side::head ? factor : 1)}};
  };
  fake.command = [name](Side side, const std::string&) { return std::string(name_of(side)) + " " + name; };
  return fake;
}

struct Outcome {
  SampleSet samples;
  std::vector<JudgedFigure> figures;

  const JudgedFigure& of(const std::string& name) const {
    return *std::ranges::find(figures, name, &JudgedFigure::case_name);
  }
  Judgment verdict() const { return judgment_of(figures); }
};

Outcome gate(const std::vector<TimedTarget>& targets, std::uint64_t seed, const Rules& rules = {}) {
  Outcome outcome;
  outcome.samples = measure_times(targets, rules, nullptr, seed, {});
  outcome.figures = judge_times(outcome.samples, rules, nullptr);
  return outcome;
}

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
    seconds.begin()->second *= is_slow ? 1.2 : 1;
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

TEST(TimeLayer, ACaseOfOneProgramOnlyIsIncomparable) {
  TimedTarget fake = {"two", "real_time"};
  fake.run = [](const RunRequest& request) {
    return std::map<std::string, double>{{"both", 1}, {request.side == Side::head ? "new" : "old", 1}};
  };
  fake.command = [](Side, const std::string& name) { return name; };
  const Outcome outcome = gate({fake}, 1);
  EXPECT_EQ(outcome.of("both").verdict, Judgment::passed);
  EXPECT_EQ(outcome.of("new").verdict, Judgment::incomparable);
  EXPECT_EQ(outcome.of("old").verdict, Judgment::incomparable);
  EXPECT_NE(outcome.of("new").words, outcome.of("old").words);
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
  const SampleSet samples = measure_times(std::vector{target("a", 1.06, 1)}, {}, nullptr, 1, {});
  EXPECT_EQ(judgment_of(judge_times(samples, {}, nullptr)), Judgment::worse);
  EXPECT_EQ(judgment_of(judge_times(samples, {}, &calibration)), Judgment::passed);
}

TEST(PairStatistics, ThresholdIsTheLargestOfAll) {
  const TimeRules rules = {.relative = 0.01, .absolute_seconds = 0.001};
  EXPECT_DOUBLE_EQ(threshold_of(rules, 1, 0), std::log1p(0.01));
  EXPECT_DOUBLE_EQ(threshold_of(rules, 0.02, 0), std::log1p(0.05));
  EXPECT_DOUBLE_EQ(threshold_of(rules, 1, 0.03), 0.03);
}

TEST(PairStatistics, ConfirmationIsStricterWithMoreSuspects) {
  EXPECT_DOUBLE_EQ(confirmation_confidence({.confidence = 0.95}, 1), 0.95);
  EXPECT_DOUBLE_EQ(confirmation_confidence({.confidence = 0.95}, 10), 0.995);
  const bench::Bootstrap few = bootstrap_for(0.95, 1), many = bootstrap_for(0.9995, 1);
  EXPECT_GT(many.resamples, few.resamples);
}

TEST(PairStatistics, LooksGrowUpToTheMost) {
  const TimeRules rules = {.at_least = 20, .at_most = 200};
  int pairs = 0, looks = 0;
  while (pairs < 200) {
    const int next = next_look(pairs, rules);
    ASSERT_GT(next, pairs);
    pairs = next;
    ++looks;
  }
  EXPECT_EQ(pairs, 200);
  EXPECT_LE(looks, 8);
  EXPECT_EQ(next_look(0, {.at_least = 1, .at_most = 2}), 1);
  EXPECT_EQ(next_look(1, {.at_least = 1, .at_most = 2}), 2);
}

}  // namespace
}  // namespace ccdt::gate
