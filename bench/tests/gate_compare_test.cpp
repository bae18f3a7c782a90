#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "bench/gate/compare.h"
#include "bench/gate/program_counts.h"
#include "bench/gate/verdict.h"

namespace ccdt::gate {
namespace {

/// A recording of one case with these counts.
Recording recording_of(const std::vector<std::pair<std::string, double>>& counts) {
  Recording recording;
  CaseFigures& one = case_named("part", recording);
  for (const auto& [name, count] : counts) one.figures.push_back({name, Layer::exact, {count}});
  return recording;
}

std::vector<Judgment> judgments_of(const Recording& base, const Recording& head, const Rules& rules = {}) {
  std::vector<Judgment> all;
  for (const JudgedFigure& figure : compare_exact(base, head, rules)) all.push_back(figure.verdict);
  return all;
}

// Reports leave out counts of work that are 0.
TEST(CompareExactTest, WorkThatIsNotInAReportIsZero) {
  const Recording without = recording_of({{"work.front.faces_tested", 5}});
  const Recording with = recording_of({{"work.front.faces_tested", 5}, {"work.front.exact_evaluations", 1}});
  EXPECT_EQ(judgments_of(without, with), (std::vector{Judgment::passed, Judgment::worse}));
  EXPECT_EQ(judgments_of(with, without), (std::vector{Judgment::passed, Judgment::passed}));
}

TEST(CompareExactTest, WorkIsNotComparedWithABaseThatDidNotCountIt) {
  const Recording old = recording_of({{"counts.faces", 5}});
  const Recording now = recording_of({{"counts.faces", 5}, {"work.front.faces_tested", 1}});
  EXPECT_EQ(judgments_of(old, now), (std::vector{Judgment::passed, Judgment::passed}));
  EXPECT_EQ(judgments_of(now, old), (std::vector{Judgment::passed, Judgment::worse}));
}

TEST(CompareExactTest, TheToleranceIsAShareOfTheBase) {
  const auto verdict = [](double tolerance) {
    Rules rules;
    rules.exact.tolerances = {{"work.*", tolerance}};
    return judgments_of(recording_of({{"work.steps", 1000}}), recording_of({{"work.steps", 1100}}), rules).front();
  };
  EXPECT_EQ(verdict(0.095), Judgment::worse);
  EXPECT_EQ(verdict(0.105), Judgment::passed);
}

TEST(CompareInstructionsTest, CountsUnderOtherConditionsAreNotCompared) {
  Recording base, head;
  case_named("part", base).figures.push_back({"instructions.mesh", Layer::instructions, {1e8}});
  case_named("part", head).figures.push_back({"instructions.mesh", Layer::instructions, {2e8}});
  base.identity["instructions.cpu"] = head.identity["instructions.cpu"] = "one";
  Rules rules;
  EXPECT_EQ(compare_instructions(base, head, rules).front().verdict, Judgment::worse);
  head.identity["instructions.cpu"] = "another";
  EXPECT_EQ(compare_instructions(base, head, rules).front().verdict, Judgment::incomparable);
  EXPECT_FALSE(compare_instructions(base, head, rules).front().is_gated);
  rules.layers_are_chosen = true;
  EXPECT_TRUE(compare_instructions(base, head, rules).front().is_gated) << "who asks for it must get a verdict";
  head.identity.clear();
  EXPECT_EQ(compare_instructions(base, head, rules).front().verdict, Judgment::incomparable) << "one is not known";
}

JudgedFigure judged(Judgment verdict, const std::string& name = "work.steps") {
  JudgedFigure figure;
  figure.name = name;
  figure.verdict = verdict;
  return figure;
}

TEST(VerdictTest, TheGravestFigureDecides) {
  const JudgedFigure worse = judged(Judgment::worse), undecided = judged(Judgment::undecided),
                     incomparable = judged(Judgment::incomparable), passed = judged(Judgment::passed);
  EXPECT_EQ(judgment_of({passed, incomparable, undecided, worse}), Judgment::worse);
  EXPECT_EQ(judgment_of({passed, incomparable, undecided}), Judgment::undecided);
  EXPECT_EQ(judgment_of({passed, incomparable}), Judgment::incomparable);
  EXPECT_EQ(judgment_of({passed}), Judgment::passed);
  JudgedFigure listed = worse;
  listed.is_gated = false;
  EXPECT_EQ(judgment_of({passed, listed}), Judgment::passed);
}

TEST(VerdictTest, WithoutPerformanceThereIsNothingToCompare) {
  EXPECT_EQ(judgment_of({}), Judgment::incomparable);
  for (const char* name : {"status", "kind", "exit_codes", case_figure})
    EXPECT_EQ(judgment_of({judged(Judgment::passed, name)}), Judgment::incomparable) << name;
}

TEST(VerdictTest, ALayerThatTheUserChoseMustBeJudged) {
  Verdict verdict;
  verdict.figures = {judged(Judgment::passed)};
  conclude(verdict);
  EXPECT_EQ(verdict.verdict, Judgment::passed);
  verdict.rules.layers_are_chosen = true;
  conclude(verdict);
  EXPECT_EQ(verdict.verdict, Judgment::incomparable);
  verdict.rules.layers = {Layer::exact};
  conclude(verdict);
  EXPECT_EQ(verdict.verdict, Judgment::passed);
}

// Counts of any program.

JudgedFigure count_of(const std::string& name, const ProgramCounts& base, const ProgramCounts& again,
                      const ProgramCounts& head) {
  for (const JudgedFigure& figure : judge_counts("a", base, again, head, {}))
    if (figure.name == "instructions." + name) return figure;
  ADD_FAILURE() << name << " is not judged";
  return {};
}

TEST(ProgramCountsTest, MoreInstructionsAreWorseBeyondTheShareOfTheRules) {
  const auto verdict = [](std::uint64_t base, std::uint64_t again, std::uint64_t head) {
    return count_of("total", {base}, {again}, {head}).verdict;
  };
  EXPECT_EQ(verdict(1000000, 1000000, 1004000), Judgment::passed);
  EXPECT_EQ(verdict(1000000, 1000000, 1006000), Judgment::worse);
  EXPECT_EQ(verdict(1000000, 1002000, 1006000), Judgment::passed) << "of the run of the base that took more";
  EXPECT_EQ(verdict(1002000, 1000000, 1008000), Judgment::worse);
  EXPECT_EQ(verdict(1000000, 1003000, 1000000), Judgment::undecided) << "the base does not repeat itself";
  EXPECT_EQ(verdict(1000000, 1003000, 1020000), Judgment::worse);
}

TEST(ProgramCountsTest, OneMoreSystemCallOrAllocationIsWorse) {
  const ProgramCounts base = {1000000, 10, 20}, call = {1000000, 11, 20}, allocation = {1000000, 10, 21};
  EXPECT_EQ(count_of("system_calls", base, base, call).verdict, Judgment::worse);
  EXPECT_EQ(count_of("allocations", base, base, call).verdict, Judgment::passed);
  EXPECT_EQ(count_of("allocations", base, base, allocation).verdict, Judgment::worse);
  EXPECT_EQ(count_of("allocations", allocation, allocation, base).verdict, Judgment::passed);
}

TEST(ProgramCountsTest, ACountThatTheBaseDoesNotRepeatIsNotGated) {
  const JudgedFigure calls = count_of("system_calls", {1000000, 10, 20}, {1000000, 11, 20}, {1000000, 14, 20});
  EXPECT_EQ(calls.verdict, Judgment::incomparable);
  EXPECT_FALSE(calls.is_gated);
}

TEST(ProgramCountsTest, AnAllocationByAnotherOneIsTheSameAllocation) {
  ProgramCounts counts;
  add_profile(
      "positions: line\nevents: Ir\n"
      "fn=(1) main\n0 50\ncfn=(2) realloc\ncalls=2 0\n0 30\ncfn=(3) malloc\ncalls=1 0\n0 5\n"
      "fn=(2)\n0 10\ncfn=(3)\ncalls=2 0\n0 20\n"
      "fn=(3)\n0 25\n",
      counts);
  EXPECT_EQ(counts.allocations, 3U);
  EXPECT_EQ(counts.instructions, 85U);
}

}  // namespace
}  // namespace ccdt::gate
