#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/gate/judge_times.h"
#include "bench/gate/measure_times.h"
#include "bench/gate/paired_samples.h"
#include "bench/gate/timed_targets.h"

/// Programs with made-up times.
namespace ccdt::gate {

/// Cases that took these seconds.
inline Measured measured(const std::map<std::string, double>& seconds) {
  Measured all;
  for (const auto& [name, value] : seconds) all[name] = {.seconds = value, .timed_seconds = value};
  return all;
}

/// Samples of one program, before the first pair.
inline SampleSet start_samples(std::uint64_t seed) {
  SampleSet samples;
  samples.seed = seed;
  samples.base_program = samples.head_program = "one program";
  return samples;
}

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
inline TimedTarget target(const std::string& name, double factor, std::uint64_t seed, double noise = 0.02) {
  TimedTarget fake = {name, "seconds.mesh"};
  fake.run = [=, program = std::make_shared<FakeProgram>(seed, noise)](const RunRequest& request) {
    return measured({{name, program->seconds() * (request.side == Side::head ? factor : 1)}});
  };
  fake.command = [name](Side side, const std::string&) { return std::string(name_of(side)) + " " + name; };
  return fake;
}

inline PairedSamples case_without_times(const std::string& name) {
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

inline Outcome gate(const std::vector<TimedTarget>& targets, std::uint64_t seed, const Rules& rules = {}) {
  Outcome outcome;
  outcome.samples = start_samples(seed);
  measure_times(targets, rules, {}, outcome.samples);
  outcome.figures = judge_times(outcome.samples, rules, nullptr);
  return outcome;
}

/// Pairs whose head takes this many times as long, with little noise.
inline std::vector<Pair> pairs_of(double factor) {
  std::vector<Pair> pairs;
  for (int i = 0; i < 20; ++i) pairs.push_back({1, factor * std::exp(i % 2 == 0 ? 0.001 : -0.001)});
  return pairs;
}

}  // namespace ccdt::gate
