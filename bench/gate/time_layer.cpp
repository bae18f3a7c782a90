#include "bench/gate/time_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "bench/gate/pair_statistics.h"
#include "bench/results/numbers.h"

namespace ccdt::gate {
namespace {

constexpr std::size_t most_padding = 4096;  ///< bytes; one page, since the stack begins at a random page anyway

using results::percent;

using Seconds = std::map<std::string, double>;

/// Runs targets in pairs.
class PairTaker {
 public:
  explicit PairTaker(std::uint64_t seed) : random_(seed) {}

  struct Both {
    Seconds base, head;
    bool head_first = false;
  };

  Both take(const TimedTarget& target, const std::set<std::string>& cases) {
    Both both;
    both.head_first = draw(2) == 1;
    for (const Side side : both.head_first ? std::array{Side::head, Side::base} : std::array{Side::base, Side::head})
      (side == Side::base ? both.base : both.head) = target.run({side, draw(most_padding), cases});
    return both;
  }

 private:
  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_() >> 32) * count >> 32; }

  std::mt19937_64 random_;
};

/// The cases of one target: the indices of their samples, and the pairs that are still wanted.
struct TargetCases {
  const TimedTarget& target;
  std::vector<std::size_t> samples;
};

double median_of_base(std::span<const Pair> pairs) {
  return bench::median(seconds_of(pairs, Side::base));
}

/// How to judge a case.
struct CaseThresholds {
  const TimeRules& rules;
  double noise_floor = 0;
};

CaseThresholds thresholds_of(const PairedSamples& samples, const Rules& rules, const Calibration* calibration) {
  const CaseNoise* noise = calibration ? find_noise(*calibration, samples.case_name) : nullptr;
  return {time_rules_of(rules, samples.case_name), noise ? noise->noise_floor : 0};
}

Look screen(const PairedSamples& samples, const CaseThresholds& thresholds, std::uint64_t seed) {
  const auto& [rules, floor] = thresholds;
  return look_at(log_ratios(samples.screening), threshold_of(rules, median_of_base(samples.screening), floor), rules,
                 bootstrap_for(rules.confidence, seed));
}

/// The threshold is that of the screening.
Look confirm(const PairedSamples& samples, const Look& screening, int suspects, const TimeRules& rules,
             std::uint64_t seed) {
  return look_at(log_ratios(samples.confirmation), screening.threshold, rules,
                 bootstrap_for(confirmation_confidence(rules, suspects), seed));
}

PairedSamples samples_for(const TimedTarget& target, const std::string& case_name, const PairTaker::Both& both) {
  PairedSamples samples;
  samples.case_name = case_name;
  samples.figure = target.figure;
  samples.in_base_only = !both.head.contains(case_name);
  samples.in_head_only = !both.base.contains(case_name);
  if (!samples.in_head_only) samples.base_command = target.command(Side::base, case_name);
  if (!samples.in_base_only) samples.head_command = target.command(Side::head, case_name);
  return samples;
}

/// Measures until all cases are decided.
class Measurement {
 public:
  Measurement(const Rules& rules, const Calibration* calibration, std::uint64_t seed, const Progress& progress)
      : rules_(rules), calibration_(calibration), taker_(seed), progress_(progress) {
    all_.seed = seed;
  }

  /// Runs a target once in pairs, to warm up and to find its cases.
  void begin(const TimedTarget& target) {
    const PairTaker::Both both = taker_.take(target, {});
    Seconds either = both.base;
    either.insert(both.head.begin(), both.head.end());
    TargetCases cases = {target, {}};
    for (const auto& [name, seconds] : either) {
      if (!is_gated(rules_, Layer::time, name, target.figure)) continue;
      cases.samples.push_back(all_.cases.size());
      all_.cases.push_back(samples_for(target, name, both));
    }
    targets_.push_back(std::move(cases));
  }

  void screen_all() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < all_.cases.size(); ++i)
      if (comparable(all_.cases[i])) open.push_back(i);
    while (!open.empty()) {
      take_more(open, &PairedSamples::screening);
      std::erase_if(open, [&](std::size_t i) {
        const PairedSamples& samples = all_.cases[i];
        const CaseThresholds thresholds = thresholds_of(samples, rules_, calibration_);
        return screen(samples, thresholds, all_.seed).call != Call::open ||
               static_cast<int>(samples.screening.size()) >= thresholds.rules.at_most;
      });
    }
  }

  void confirm_suspects() {
    std::map<std::size_t, Look> suspects;
    for (std::size_t i = 0; i < all_.cases.size(); ++i) {
      if (!comparable(all_.cases[i])) continue;
      const Look look = screen(all_.cases[i], thresholds_of(all_.cases[i], rules_, calibration_), all_.seed);
      if (look.call == Call::worse) suspects.emplace(i, look);
    }
    std::vector<std::size_t> open;
    for (const auto& [i, look] : suspects) open.push_back(i);
    while (!open.empty()) {
      take_more(open, &PairedSamples::confirmation);
      std::erase_if(open, [&](std::size_t i) {
        const TimeRules& rules = thresholds_of(all_.cases[i], rules_, calibration_).rules;
        const Look& screening = suspects.at(i);
        const Look look = confirm(all_.cases[i], screening, static_cast<int>(suspects.size()), rules, all_.seed);
        return half_width(look.log_ratio) <= wanted_half_width(screening, rules) ||
               static_cast<int>(all_.cases[i].confirmation.size()) >= rules.at_most;
      });
    }
  }

  SampleSet take() { return std::move(all_); }

 private:
  static bool comparable(const PairedSamples& samples) { return !samples.in_base_only && !samples.in_head_only; }

  /// Measures as many pairs of each of these cases as the next look needs.
  void take_more(const std::vector<std::size_t>& wanted, std::vector<Pair> PairedSamples::*pairs) {
    for (const auto& [target, samples] : targets_) {
      std::map<std::string, std::size_t> cases;
      int count = 0;
      for (const std::size_t i : samples) {
        if (!std::ranges::binary_search(wanted, i)) continue;
        const auto now = static_cast<int>((all_.cases[i].*pairs).size());
        cases.emplace(all_.cases[i].case_name, i);
        count = std::max(count, next_look(now, time_rules_of(rules_, all_.cases[i].case_name)) - now);
      }
      for (int n = 0; n < count; ++n) take_pair(target, cases, pairs);
    }
  }

  void take_pair(const TimedTarget& target, const std::map<std::string, std::size_t>& cases,
                 std::vector<Pair> PairedSamples::*pairs) {
    std::set<std::string> names;
    for (const auto& [name, i] : cases) names.insert(name);
    const PairTaker::Both both = taker_.take(target, names);
    report(progress_, "pairs of runs", ++pairs_, 0);
    for (const auto& [name, i] : cases)
      (all_.cases[i].*pairs).push_back({both.base.at(name), both.head.at(name), both.head_first});
  }

  const Rules& rules_;
  const Calibration* calibration_;
  PairTaker taker_;
  const Progress& progress_;
  std::uint64_t pairs_ = 0;
  std::vector<TargetCases> targets_;
  SampleSet all_;
};

std::string times(int pairs) {
  return std::to_string(pairs) + (pairs == 1 ? " pair" : " pairs");
}

/// The verdict on a case that exists in only one program.
JudgedFigure judge_missing(const PairedSamples& samples) {
  JudgedFigure judged;
  judged.name = samples.figure;
  judged.case_name = samples.case_name;
  judged.layer = Layer::time;
  judged.verdict = Judgment::incomparable;
  judged.words = samples.in_base_only ? "there is no such case in head" : "there is no such case in base";
  judged.command = samples.in_base_only ? samples.base_command : samples.head_command;
  return judged;
}

JudgedFigure judge_look(const PairedSamples& samples, std::span<const Pair> pairs, const Look& look) {
  JudgedFigure judged;
  judged.name = samples.figure;
  judged.case_name = samples.case_name;
  judged.layer = Layer::time;
  judged.base = median_of_base(pairs);
  judged.head = bench::median(seconds_of(pairs, Side::head));
  const auto& [value, low, high] = look.log_ratio;
  judged.ratio = std::exp(value);
  judged.interval = bench::Estimate{std::exp(value), std::exp(low), std::exp(high)};
  judged.badness = value;
  judged.command = samples.head_command;
  return judged;
}

std::string noise_words(const Look& look, std::size_t pairs, const TimeRules& rules) {
  return "noise: the interval is " + percent(half_width(look.log_ratio)) + " wide on either side after " +
         times(static_cast<int>(pairs)) + ", and " + percent(rules.largest_noise) + " is the largest for a verdict";
}

JudgedFigure judge_screened(const PairedSamples& samples, const Look& look, const TimeRules& rules) {
  JudgedFigure judged = judge_look(samples, samples.screening, look);
  if (is_too_wide(look, rules)) {
    judged.verdict = Judgment::undecided;
    judged.words = noise_words(look, samples.screening.size(), rules);
  } else if (look.log_ratio.high < -look.threshold) {
    judged.changed = true;
    judged.words = "faster by more than " + percent(std::expm1(look.threshold));
  } else {
    judged.words = "not slower by more than " + percent(std::expm1(look.threshold));
  }
  return judged;
}

JudgedFigure judge_suspect(const PairedSamples& samples, const Look& look, const TimeRules& rules) {
  JudgedFigure judged = judge_look(samples, samples.confirmation, look);
  const std::string threshold = percent(std::expm1(look.threshold));
  if (look.call == Call::worse) {
    judged.verdict = Judgment::worse;
    judged.changed = true;
    judged.words = "slower by more than " + threshold + ", and again in " +
                   times(static_cast<int>(samples.confirmation.size())) + " afresh";
  } else if (is_too_wide(look, rules)) {
    judged.verdict = Judgment::undecided;
    judged.words = noise_words(look, samples.confirmation.size(), rules);
  } else {
    judged.words = "slower by more than " + threshold + " at first, but not in " +
                   times(static_cast<int>(samples.confirmation.size())) + " afresh";
  }
  return judged;
}

}  // namespace

std::string correction_words() {
  return "Each case that looks worse is measured again with fresh pairs. With n such cases, the confidence of each new "
         "interval is 1 - (1 - confidence) / n (Bonferroni), however many cases there are in all.";
}

SampleSet measure_times(std::span<const TimedTarget> targets, const Rules& rules, const Calibration* calibration,
                        std::uint64_t seed, const Progress& progress) {
  Measurement measurement(rules, calibration, seed, progress);
  for (const TimedTarget& target : targets) measurement.begin(target);
  measurement.screen_all();
  measurement.confirm_suspects();
  return measurement.take();
}

std::vector<JudgedFigure> judge_times(const SampleSet& samples, const Rules& rules, const Calibration* calibration) {
  const auto is_suspect = [](const PairedSamples& s) { return !s.confirmation.empty(); };
  const auto suspects = static_cast<int>(std::ranges::count_if(samples.cases, is_suspect));
  std::vector<JudgedFigure> judged;
  for (const PairedSamples& s : samples.cases) {
    if (s.screening.empty()) {
      judged.push_back(judge_missing(s));
      continue;
    }
    const CaseThresholds thresholds = thresholds_of(s, rules, calibration);
    const Look screening = screen(s, thresholds, samples.seed);
    if (!is_suspect(s) || screening.call != Call::worse)
      judged.push_back(judge_screened(s, screening, thresholds.rules));
    else
      judged.push_back(
          judge_suspect(s, confirm(s, screening, suspects, thresholds.rules, samples.seed), thresholds.rules));
  }
  return judged;
}

SampleSet measure_noise(std::span<const TimedTarget> targets, int pairs, std::uint64_t seed, const Progress& progress) {
  // Rules whose only look is the last one: no case is decided earlier.
  Rules rules;
  rules.time = {.at_least = pairs, .at_most = pairs};
  std::vector<TimedTarget> unchanged(targets.begin(), targets.end());
  for (TimedTarget& target : unchanged)
    target.run = [run = target.run](RunRequest request) {
      request.side = Side::base;
      return run(request);
    };
  Measurement measurement(rules, nullptr, seed, progress);
  for (const TimedTarget& target : unchanged) measurement.begin(target);
  measurement.screen_all();
  return measurement.take();
}

}  // namespace ccdt::gate
