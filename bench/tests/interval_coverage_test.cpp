#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "bench/run/case.h"
#include "bench/run/median_interval.h"

/// How often intervals contain the truth, with the rule by which the runner stops. The seeds are fixed.
namespace ccdt {
namespace {

using Random = std::mt19937_64;
using bench::Estimate;
using bench::Repetitions;

constexpr int simulations = 5000;  // the standard deviation of a coverage of 95% is 0.31%
constexpr double least_coverage = 0.94;

double normal(Random& random) {
  return std::normal_distribution<double>()(random);
}
double exponential(Random& random) {
  return std::exponential_distribution<double>()(random);
}
bool happens(Random& random, double probability) {
  return std::uniform_real_distribution<double>()(random) < probability;
}

/// Distribution functions.
double below_normal(double x) {
  return std::erfc(-x / std::sqrt(2)) / 2;
}
double below_exponential(double x) {
  return x > 0 ? 1 - std::exp(-x) : 0;
}

/// Seconds of runs, which may depend on the number of the run.
struct Process {
  const char* name;
  double (*draw)(Random& random, int run);
  double (*probability_below)(double seconds, int run);
};

const std::vector<Process> processes = {
    {"normal", [](Random& random, int) { return 1 + 0.05 * normal(random); },
     [](double s, int) { return below_normal((s - 1) / 0.05); }},
    {"lognormal", [](Random& random, int) { return std::exp(0.2 * normal(random)); },
     [](double s, int) { return s > 0 ? below_normal(std::log(s) / 0.2) : 0; }},
    {"exponential tail", [](Random& random, int) { return 1 + 0.1 * exponential(random); },
     [](double s, int) { return below_exponential((s - 1) / 0.1); }},
    {"bimodal 80/20", [](Random& random, int) { return (happens(random, 0.2) ? 1.3 : 1) + 0.01 * normal(random); },
     [](double s, int) { return 0.8 * below_normal((s - 1) / 0.01) + 0.2 * below_normal((s - 1.3) / 0.01); }},
    {"bimodal 50/50", [](Random& random, int) { return (happens(random, 0.5) ? 1.2 : 1) + 0.01 * normal(random); },
     [](double s, int) { return 0.5 * below_normal((s - 1) / 0.01) + 0.5 * below_normal((s - 1.2) / 0.01); }},
    {"drift", [](Random& random, int run) { return 1 + 0.004 * run + 0.03 * normal(random); },
     [](double s, int run) { return below_normal((s - 1 - 0.004 * run) / 0.03); }},
    {"drift, tail", [](Random& random, int run) { return 1 + 0.004 * run + 0.05 * exponential(random); },
     [](double s, int run) { return below_exponential((s - 1 - 0.004 * run) / 0.05); }}};

/// The median of the process over its first runs.
double median_of(const Process& process, std::size_t runs) {
  double low = 0, high = 4;
  for (int step = 0; step < 60; ++step) {
    const double middle = (low + high) / 2;
    double below = 0;
    for (std::size_t run = 0; run < runs; ++run) below += process.probability_below(middle, static_cast<int>(run));
    (below < 0.5 * static_cast<double>(runs) ? low : high) = middle;
  }
  return low;
}

struct Design {
  const char* name;
  Repetitions repetitions;
};

Repetitions fixed(int runs) {
  return {.at_least = runs, .at_most = runs};
}

const std::vector<Design> all_designs = {
    {"6", fixed(6)},
    {"7", fixed(7)},
    {"8", fixed(8)},
    {"9", fixed(9)},
    {"12", fixed(12)},
    {"17", fixed(17)},
    {"20", fixed(20)},
    {"60", fixed(60)},
    {"6-9", {.at_least = 6, .at_most = 9, .until = 0.05}},
    {"6-20", {.at_least = 6, .at_most = 20, .until = 0.05}},
    {"6-60", {.at_least = 6, .at_most = 60, .until = 0.05}},
    {"6-60 2%", {.at_least = 6, .at_most = 60, .until = 0.02}},
    {"9-200", {.at_least = 9, .at_most = 200, .until = 0.03}},
    {"budget", {.at_least = 6, .at_most = 60, .until = 0.05, .budget_seconds = 18.5}}};

/// Ratios use the intervals of medians, so fewer designs are enough to test their coverage.
const std::vector<Design> designs_of_ratios = {all_designs[0], all_designs[3],  all_designs[6],
                                               all_designs[9], all_designs[10], all_designs[13]};

/// Runs until they are enough, as `needs_run` decides.
template <class Draw>
std::vector<double> samples_of(const Repetitions& repetitions, Draw draw) {
  std::vector<double> samples;
  double sum = 0;
  while (!are_enough(repetitions, samples, sum)) sum += samples.emplace_back(draw(static_cast<int>(samples.size())));
  return samples;
}

bool covers(const Estimate& estimate, double truth) {
  return estimate.low <= truth && truth <= estimate.high;
}

double share(int part) {
  return static_cast<double>(part) / simulations;
}

double coverage_of_median(const Process& process, const Repetitions& repetitions) {
  Random random(1);
  std::map<std::size_t, double> truths;  // by the number of runs
  const std::vector<int> looks = looks_of(repetitions);
  int covered = 0;
  for (int trial = 0; trial < simulations; ++trial) {
    const auto samples = samples_of(repetitions, [&](int run) { return process.draw(random, run); });
    double& truth = truths[samples.size()];
    if (truth == 0) truth = median_of(process, samples.size());
    covered += covers(bench::median_estimate(samples, looks), truth);
  }
  return share(covered);
}

/// Two cases that take turns while the machine gets slower; the first takes twice as long.
struct Pair {
  std::string name;
  const Process *above, *below;
  double slowdown = 0.01;  ///< from one round to the next

  double draw(const Process& process, Random& random, int round) const {
    return (1 + slowdown * round) * process.draw(random, 0);
  }
};

/// The median of the ratios of a round; twice the ratio of the medians if both have the same distribution.
double median_ratio_of(const Pair& pair) {
  if (pair.above == pair.below) return 2;
  Random random(2);
  std::vector<double> ratios(400001);
  for (double& ratio : ratios) ratio = 2 * pair.above->draw(random, 0) / pair.below->draw(random, 0);
  return bench::median(ratios);
}

double coverage_of_ratio(const Pair& pair, const Repetitions& repetitions) {
  Random random(3);
  const std::vector<int> looks = looks_of(repetitions);
  const double truth = median_ratio_of(pair);
  int covered = 0;
  for (int trial = 0; trial < simulations; ++trial) {
    // The slower machine is felt by both in the same round.
    const auto above = samples_of(repetitions, [&](int run) { return 2 * pair.draw(*pair.above, random, run); });
    const auto below = samples_of(repetitions, [&](int run) { return pair.draw(*pair.below, random, run); });
    covered += covers(bench::median_ratio(above, below, looks), truth);
  }
  return share(covered);
}

/// Prints a table of coverages in percent, one row for each name, and expects all of them to be large enough.
template <class Rows, class Coverage>
void expect_coverage(const char* of, const Rows& rows, const std::vector<Design>& designs, Coverage coverage) {
  std::printf("coverage of %s in percent, by runs\n%-22s", of, "");
  for (const Design& design : designs) std::printf(" %8s", design.name);
  std::printf("\n");
  for (const auto& row : rows) {
    std::printf("%-22s", std::string(row.name).c_str());
    for (const Design& design : designs) {
      const double covered = coverage(row, design.repetitions);
      std::printf(" %8.2f", 100 * covered);
      EXPECT_GE(covered, least_coverage) << row.name << ", " << design.name;
    }
    std::printf("\n");
  }
}

TEST(Coverage, OfMediansIsAtLeast94PercentWithTheRuleByWhichRunsStop) {
  expect_coverage("medians", processes, all_designs, coverage_of_median);
}

TEST(Coverage, OfRatiosOfCasesInTurnsIsAtLeast94PercentWithTheRuleByWhichRunsStop) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < 5; ++i) pairs.push_back({processes[i].name, &processes[i], &processes[i]});
  pairs.push_back({"normal / 80/20", &processes[0], &processes[3]});
  pairs.push_back({"lognormal / tail", &processes[1], &processes[2]});
  pairs.push_back({"50/50 / normal", &processes[4], &processes[0]});
  expect_coverage("ratios", pairs, designs_of_ratios, coverage_of_ratio);
}

/// The coverage of a measurement that stops after any run, up to the last look.
double coverage_without_looks(const Process& process, const std::vector<int>& looks_of_interval) {
  Random random(4);
  const double truth = median_of(process, 1);
  int covered = 0;
  for (int trial = 0; trial < simulations; ++trial) {
    std::vector<double> samples;
    Estimate estimate = bench::without_interval(0);
    while (samples.size() < 60 && (samples.empty() || bench::relative_spread(estimate) > 0.05)) {
      samples.push_back(process.draw(random, 0));
      estimate = bench::median_estimate(samples, looks_of_interval);
    }
    covered += covers(estimate, truth);
  }
  return share(covered);
}

/// This is why runs stop only at looks.
TEST(Coverage, OfAStopAfterAnyRunIsTooSmall) {
  const Process& bimodal = processes[4];
  EXPECT_LT(coverage_without_looks(bimodal, {}), 0.85);
  EXPECT_LT(coverage_without_looks(bimodal, bench::looks_between(6, 60)), least_coverage);
}

TEST(Coverage, ACaseStopsOnlyAtALook) {
  constexpr Repetitions until = {.at_least = 6, .at_most = 60, .until = 0.05};
  const std::vector<int> looks = looks_of(until);
  for (int runs = 0; runs < 60; ++runs)
    EXPECT_EQ(are_enough(until, std::vector<double>(static_cast<std::size_t>(runs), 1.0), runs),
              std::ranges::find(looks, runs) != looks.end())
        << runs;
}

TEST(Coverage, AFixedNumberOfRunsIsItsOnlyLook) {
  EXPECT_EQ(bench::looks_of({.at_least = 6, .at_most = 60}), std::vector<int>{6});
  EXPECT_EQ(bench::looks_of({.at_least = 3, .at_most = 3}), std::vector<int>{3});
}

TEST(Coverage, ACaseStopsByTheIntervalThatItShows) {
  constexpr Repetitions until = {.at_least = 6, .at_most = 60, .until = 0.05};
  std::vector<double> samples(18, 1.0);
  std::fill_n(samples.begin(), 4, 0.9);
  std::fill_n(samples.rbegin(), 4, 1.1);
  EXPECT_LT(bench::relative_spread(bench::median_estimate(samples)), 0.05) << "if 18 had been fixed";
  EXPECT_FALSE(are_enough(until, samples, 18));
  samples[3] = samples[14] = 1;
  EXPECT_TRUE(are_enough(until, samples, 18));
}

TEST(Coverage, ACaseStopsIfTheNextLookIsBeyondTheBudget) {
  constexpr Repetitions budget = {.at_least = 6, .at_most = 60, .until = 0.05, .budget_seconds = 18};
  const std::vector<double> wide = {1, 2, 3, 4, 5, 6};
  EXPECT_FALSE(are_enough(budget, wide, 6));
  EXPECT_TRUE(are_enough(budget, wide, 6.01));
  EXPECT_FALSE(are_enough(budget, std::span(wide).first(5), 1000));
}

}  // namespace
}  // namespace ccdt
