#include "bench/gate/judge_times.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "bench/tests/fake_targets.h"

namespace ccdt::gate {
namespace {

// Verdicts on given times.

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

}  // namespace
}  // namespace ccdt::gate
