#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "baselines/external_program.h"
#include "bench/gate/judge_times.h"
#include "bench/gate/measure_times.h"
#include "bench/gate/pair_statistics.h"
#include "bench/tests/fake_targets.h"

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
    return measured({{name, program->seconds() * (request.side == Side::head ? factor : 1)}});
  };
  fake.command = [name](Side side, const std::string&) { return std::string(name_of(side)) + " " + name; };
  return fake;
}

PairedSamples case_without_times(const std::string& name) {
  PairedSamples one;
  one.case_name = name;
  one.figure = "seconds.mesh";
  return one;
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
  outcome.samples = start_samples(seed);
  measure_times(targets, rules, {}, outcome.samples);
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

// Verdicts of given times.

/// Pairs whose head takes this many times as long, with little noise.
std::vector<Pair> pairs_of(double factor) {
  std::vector<Pair> pairs;
  for (int i = 0; i < 20; ++i) pairs.push_back({1, factor * std::exp(i % 2 == 0 ? 0.001 : -0.001)});
  return pairs;
}

/// One case of one program.
SampleSet samples_of(const std::vector<Pair>& screening, const std::vector<Pair>& confirmation) {
  SampleSet samples = start_samples(1);
  samples.cases.push_back(case_without_times("a"));
  samples.cases.front().screening = screening;
  samples.cases.front().confirmation = confirmation;
  return samples;
}

TEST(JudgeTimes, ACaseIsWorseIfBothMeasurementsSaySo) {
  const auto verdict = [](double first, double second) {
    return judgment_of(judge_times(samples_of(pairs_of(first), pairs_of(second)), {}, nullptr));
  };
  EXPECT_EQ(verdict(1.05, 1.05), Judgment::worse);
  EXPECT_EQ(verdict(1.05, 1), Judgment::passed);
  EXPECT_EQ(verdict(1, 1.05), Judgment::passed);
  EXPECT_EQ(verdict(1.05, 1.005), Judgment::passed) << "the threshold is that of the first measurement";
}

TEST(JudgeTimes, ASlowdownThatWasNotConfirmedIsUndecided) {
  EXPECT_EQ(judgment_of(judge_times(samples_of(pairs_of(1.05), {}), {}, nullptr)), Judgment::undecided);
}

TEST(JudgeTimes, ProgramsOfWhichNothingIsKnownMayBeTwoBuilds) {
  SampleSet samples = samples_of(pairs_of(1), {});
  const auto deviation = [&] { return precision_of(samples.cases.front(), samples, {}, nullptr).layout_deviation; };
  EXPECT_EQ(deviation(), 0) << "one program has one layout";
  samples.head_program = "another build";
  EXPECT_EQ(deviation(), builds_of_programs);
  samples.base_program = samples.head_program = "";
  EXPECT_EQ(deviation(), builds_of_programs);
  samples.is_rebuilt = true;
  EXPECT_EQ(deviation(), 0) << "layouts are part of the pairs";
}

TEST(JudgeTimes, WhatBothProgramsSkipDoesNotCount) {
  SampleSet samples = samples_of(pairs_of(1), {});
  samples.cases.push_back(case_without_times("b"));
  PairedSamples& skipped = samples.cases.back();
  const auto verdict = [&](const std::string& base, const std::string& head) {
    skipped.base_failure = base;
    skipped.head_failure = head;
    return judgment_of(judge_times(samples, {}, nullptr));
  };
  EXPECT_EQ(verdict("skipped", "skipped"), Judgment::passed);
  EXPECT_EQ(verdict("", "skipped"), Judgment::worse);
  EXPECT_EQ(verdict("skipped", ""), Judgment::incomparable);
  EXPECT_EQ(verdict("skipped", "crashed"), Judgment::incomparable);
}

// Counters.

TimedTarget counting(const std::string& counter, double base, double head, double noise = 0) {
  TimedTarget fake = {"bench", "real_time"};
  fake.command = [](Side, const std::string&) { return ""; };
  fake.run = [=, random = std::make_shared<std::mt19937_64>(5)](const RunRequest& request) {
    Measured result = measured({{"a", 1}});
    const double scatter = noise * (static_cast<double>((*random)() >> 11) * 0x1p-53 - 0.5);
    result.at("a").counters[counter] = (request.side == Side::head ? head : base) * (1 + scatter);
    return result;
  };
  return fake;
}

Judgment counter_verdict(const TimedTarget& fake, const Rules& rules = {}) {
  const Outcome outcome = gate({fake}, 1, rules);
  const auto found = std::ranges::find(outcome.figures, "counters.n", &JudgedFigure::name);
  EXPECT_NE(found, outcome.figures.end());
  return found->is_gated ? found->verdict : Judgment::incomparable;
}

TEST(CounterTest, WholeNumbersMustStayTheSame) {
  EXPECT_EQ(counter_verdict(counting("n", 12, 12)), Judgment::passed);
  EXPECT_EQ(counter_verdict(counting("n", 12, 18)), Judgment::worse);
  EXPECT_EQ(counter_verdict(counting("n", 12, 18.5)), Judgment::worse);
  EXPECT_EQ(counter_verdict(counting("n", 12, 11)), Judgment::worse) << "until a rule says that fewer is better";
}

TEST(CounterTest, OthersAreJudgedByARuleOnly) {
  Rules rules;
  EXPECT_EQ(counter_verdict(counting("n", 1.5, 2.5)), Judgment::incomparable);
  rules.exact.tolerances = {{"counters.n", 0.05}};
  rules.exact.better = {{"counters.n", Better::more}};
  EXPECT_EQ(counter_verdict(counting("n", 1.5, 2.5), rules), Judgment::passed);
  EXPECT_EQ(counter_verdict(counting("n", 1.5, 1.3), rules), Judgment::worse);
  EXPECT_EQ(counter_verdict(counting("n", 1.5, 1.48), rules), Judgment::passed);
}

TEST(CounterTest, ThoseThatScatterAreJudgedByTheRatiosOfPairs) {
  Rules rules;
  EXPECT_EQ(counter_verdict(counting("n", 1000, 1000, 0.1)), Judgment::incomparable);
  rules.exact.tolerances = {{"counters.n", 0.05}};
  rules.exact.better = {{"counters.n", Better::more}};
  EXPECT_EQ(counter_verdict(counting("n", 1000, 1000, 0.1), rules), Judgment::passed);
  EXPECT_EQ(counter_verdict(counting("n", 1000, 800, 0.1), rules), Judgment::worse);
  EXPECT_EQ(counter_verdict(counting("n", 1000, 953, 0.1), rules), Judgment::undecided);
  EXPECT_EQ(counter_verdict(counting("n", 1000, 1300, 0.1), rules), Judgment::passed);
}

TEST(CounterTest, AWholeNumberThatDiffersBetweenRunsIsNotGated) {
  TimedTarget fake = counting("n", 12, 12);
  fake.run = [run = fake.run, runs = std::make_shared<int>(0)](const RunRequest& request) {
    Measured result = run(request);
    result.at("a").counters.at("n") += (*runs)++ % 3;
    return result;
  };
  EXPECT_EQ(counter_verdict(fake), Judgment::incomparable);
  EXPECT_EQ(gate({fake}, 1).verdict(), Judgment::passed) << "its time is judged";
}

TEST(CounterTest, AnIntervalOnBothSidesOfTheToleranceIsUndecided) {
  SampleSet samples = samples_of(pairs_of(1), {});
  PairedCounter& counter = samples.cases.front().counters["n"];
  Rules rules;
  rules.exact.tolerances = {{"counters.n", 0.05}};
  const auto verdict = [&](double factor) {
    counter = {};
    for (int i = 0; i < 20; ++i) {
      counter.base.push_back(100);
      counter.head.push_back(100 * factor * std::exp(i % 2 == 0 ? 0.1 : -0.1));
    }
    return judgment_of(judge_times(samples, rules, nullptr));
  };
  EXPECT_EQ(verdict(0.9), Judgment::passed);
  EXPECT_EQ(verdict(1.04), Judgment::undecided);
  EXPECT_EQ(verdict(1.06), Judgment::undecided);
  EXPECT_EQ(verdict(1.2), Judgment::worse);
}

TEST(CounterTest, WhatIsNotANumberIsNamedAndNotGated) {
  const double nan = std::nan("");
  EXPECT_EQ(counter_verdict(counting("n", nan, nan)), Judgment::incomparable);
  EXPECT_EQ(counter_verdict(counting("n", 12, nan)), Judgment::worse);
  EXPECT_EQ(counter_verdict(counting("n", nan, 12)), Judgment::worse);
}

// Layouts.

/// A program whose builds differ in speed, for good. The head's are slower by the factor.
TimedTarget rebuilt(const std::string& name, double factor, double deviation, std::uint64_t seed) {
  TimedTarget fake = {name, "real_time"};
  fake.command = [](Side, const std::string&) { return ""; };
  fake.run = [=, noise = std::make_shared<FakeProgram>(seed)](const RunRequest& request) {
    std::mt19937_64 of_build(seed * 1000003 + static_cast<std::uint64_t>(request.layout) * 2 +
                             (request.side == Side::head));
    of_build.discard(10);
    const double speed = std::exp(deviation * std::normal_distribution<double>()(of_build));
    return measured({{name, noise->seconds() * speed * (request.side == Side::head ? factor : 1)}});
  };
  return fake;
}

Judgment gate_of_builds(double factor, double deviation, std::uint64_t seed, bool is_rebuilt) {
  std::vector<TimedTarget> targets;
  for (int i = 0; i < 10; ++i)
    targets.push_back(rebuilt("case " + std::to_string(i), i == 0 ? factor : 1, deviation, seed * 10 + i));
  SampleSet samples = start_samples(seed);
  samples.head_program = "another build";
  samples.is_rebuilt = is_rebuilt;
  measure_times(targets, {}, {}, samples);
  return judgment_of(judge_times(samples, {}, nullptr));
}

TEST(LayoutTest, BuildsThatDifferAreNoSlowdownWhetherRebuiltOrNot) {
  constexpr int gates = 100;
  int alarms_of_one = 0, alarms_of_many = 0;
  for (std::uint64_t seed = 0; seed < gates; ++seed) {
    alarms_of_one += gate_of_builds(1, builds_of_loops, seed, false) == Judgment::worse;
    alarms_of_many += gate_of_builds(1, 0.01, seed, true) == Judgment::worse;
  }
  EXPECT_LE(bench::share_of(alarms_of_one, gates).low, 0.02);
  EXPECT_LE(bench::share_of(alarms_of_many, gates).low, 0.02);
}

TEST(LayoutTest, SeveralBuildsFindFivePercent) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) found += gate_of_builds(1.05, 0.01, seed, true) == Judgment::worse;
  EXPECT_GE(found, 45);
}

TEST(LayoutTest, EachLayoutIsOneObservationAndTheConfirmationHasNewOnes) {
  SampleSet samples = start_samples(1);
  samples.is_rebuilt = true;
  Rules rules;
  rules.time.layouts = 8;
  measure_times(std::vector{rebuilt("a", 1.2, 0.01, 1)}, rules, {}, samples);
  const PairedSamples& one = samples.cases.front();
  std::map<int, int> screened, confirmed;
  for (const Pair& pair : one.screening) ++screened[pair.layout];
  for (const Pair& pair : one.confirmation) ++confirmed[pair.layout];
  EXPECT_GE(screened.size(), 8U);
  EXPECT_GE(confirmed.size(), 8U);
  for (const auto& [layout, pairs] : screened) {
    EXPECT_EQ(pairs, 3);
    EXPECT_FALSE(confirmed.contains(layout));
  }
  // With two layouts of the same difference, more pairs of them say nothing new.
  std::vector<Pair> few, many;
  for (int layout = 0; layout < 6; ++layout)
    for (int i = 0; i < 40; ++i) {
      const Pair pair = {1, std::exp(0.01 * layout), false, layout};
      if (i < 2) few.push_back(pair);
      many.push_back(pair);
    }
  EXPECT_EQ(log_ratio_of(few, {}), log_ratio_of(many, {}));
}

TEST(PairStatistics, TheThresholdIsTheLargestOfAllAndSaysWhich) {
  const TimeRules rules = {.relative = 0.01, .absolute_seconds = 0.001};
  const auto threshold = [&](double base, const Precision& precision) { return threshold_of(rules, base, precision); };
  EXPECT_DOUBLE_EQ(threshold(1, {}).value, std::log1p(0.01));
  EXPECT_EQ(threshold(1, {}).reason, ThresholdReason::relative);
  EXPECT_DOUBLE_EQ(threshold(0.02, {}).value, std::log1p(0.05));
  EXPECT_EQ(threshold(0.02, {}).reason, ThresholdReason::absolute);
  EXPECT_DOUBLE_EQ(threshold(1, {.noise_floor = 0.03}).value, 0.03);
  EXPECT_EQ(threshold(1, {.noise_floor = 0.03}).reason, ThresholdReason::noise);
  const Precision clock = {.timed_seconds = 1e-6, .clock_seconds = 1e-7};
  EXPECT_DOUBLE_EQ(threshold(1, clock).value, std::log1p(0.2));
  EXPECT_EQ(threshold(1, clock).reason, ThresholdReason::clock);
  EXPECT_EQ(threshold(1, {.layout_deviation = 0.02}).reason, ThresholdReason::layout);
  EXPECT_DOUBLE_EQ(threshold(1, {}).limit, std::log1p(0.03));
}

TEST(PairStatistics, TheFloorForBuildsGrowsWithTheirSpreadAndTheCases) {
  EXPECT_NEAR(layout_floor(0.01, 1), 2.054 * std::sqrt(2.0) * 0.01, 1e-5);
  EXPECT_NEAR(layout_floor(0.01, 10), 2.878 * std::sqrt(2.0) * 0.01, 1e-5);
  EXPECT_EQ(layout_floor(0, 10), 0);
}

TEST(PairStatistics, AnIntervalOnBothSidesOfTheLimitIsOpen) {
  const Threshold threshold = {0.01, 0.03};
  const auto call = [&](double value, double scatter) {
    std::vector<Pair> pairs;
    for (int i = 0; i < 40; ++i) pairs.push_back({1, std::exp(value + (i % 2 == 0 ? scatter : -scatter))});
    return look_at(pairs, threshold, bootstrap_for(0.95, 1)).call;
  };
  EXPECT_EQ(call(0, 0.01), Call::not_worse);
  EXPECT_EQ(call(0.029, 0.01), Call::worse);
  EXPECT_EQ(call(0.02, 0.1), Call::open);
  EXPECT_EQ(call(0.028, 0.1), Call::open) << "narrow or not, a slowdown beyond the limit is not excluded";
}

TEST(PairStatistics, NothingPassesWithAThresholdOfMoreThanHalf) {
  const auto call = [](double threshold) {
    return look_at(pairs_of(1), {std::log1p(threshold), std::log1p(threshold + 0.02)}, bootstrap_for(0.95, 1)).call;
  };
  EXPECT_EQ(call(0.4), Call::not_worse);
  EXPECT_EQ(call(0.6), Call::open);
  EXPECT_EQ(call(10), Call::open);
}

TEST(PairStatistics, ADisturbedPairDoesNotMoveItsLayout) {
  std::vector<Pair> pairs;
  for (int layout = 0; layout < 6; ++layout) pairs.insert(pairs.end(), 3, {1, std::exp(0.01 * layout), false, layout});
  const bench::Estimate quiet = log_ratio_of(pairs, {});
  pairs[7].head *= 3;
  EXPECT_EQ(log_ratio_of(pairs, {}), quiet);
}

TEST(PairStatistics, WithFewLayoutsThePairsAreTheObservations) {
  std::vector<Pair> pairs;
  for (int i = 0; i < 30; ++i) pairs.push_back({1, std::exp(0.01 * (i % 7)), false, i % 3});
  EXPECT_EQ(log_ratio_of(pairs, {}), bench::trimmed_mean_estimate(log_ratios(pairs), trimmed_share));
}

TEST(PairStatistics, TheLooksOfAScreeningTogetherHaveTheConfidenceOfTheRules) {
  EXPECT_NEAR(screening_confidence({.confidence = 0.95}), 0.9875, 1e-12);
  EXPECT_NEAR(screening_confidence({.confidence = 0.99}), 0.9975, 1e-12);
}

TEST(PairStatistics, TheSmallestSlowdownFoundIsBeyondTheThresholdByTheNoise) {
  const Look look = {{0, -0.01, 0.01}, {0.01, 0.03}};
  const double beyond = 0.01 * (1 + 1.645 / 1.96);
  EXPECT_NEAR(smallest_found(look, 200, 0.95, {}), 0.01 + beyond, 1e-4);
  EXPECT_NEAR(smallest_found(look, 50, 0.95, {}), 0.01 + beyond / 2, 1e-4) << "more pairs would have been measured";
  EXPECT_GE(pairs_for_verdict({{0.02, -0.02, 0.06}, {0.01, 0.03}, Call::open}, 20, {}), 100);
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
