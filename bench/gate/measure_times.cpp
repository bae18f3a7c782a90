#include "bench/gate/measure_times.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "bench/gate/judge_times.h"

namespace ccdt::gate {
namespace {

constexpr std::size_t most_padding = 4096;  ///< bytes; one page, since the stack begins at a random page anyway
constexpr double patience = 20;             ///< a run may take this many times as long as the first one
constexpr double least_patience = 10;       ///< seconds
constexpr int pairs_of_counters = 2;        ///< of a case whose time is not judged: do its counters stay the same?

/// The number of pairs of each layout.
int pairs_of_layout(const TimeRules& rules) {
  return (rules.at_least + rules.layouts - 1) / rules.layouts;
}

/// The number of layouts that a phase may use.
int most_layouts(const TimeRules& rules) {
  return std::max(rules.layouts, rules.at_most / pairs_of_layout(rules));
}

/// What one run of a target gave.
struct Attempt {
  Measured measured;
  std::string failure;  ///< of the whole process; empty: none
  double seconds = 0;   ///< wall-clock time
};

/// The cases of one target, as indices of their samples.
struct TargetCases {
  const TimedTarget& target;
  std::vector<std::size_t> samples = {};
  std::array<double, 2> most_seconds = {};  ///< of a run of each side
};

/// Measures until all cases are decided.
class Measurement {
 public:
  Measurement(const Rules& rules, const MeasureOptions& options, SampleSet& all)
      : rules_(rules), options_(options), all_(all), random_(all.seed) {
    if (!all.cases.empty()) random_.discard(all.cases.front().screening.size() * 3 + 1);  // not the same order again
  }

  /// Runs a target once with both programs, to warm up and to find its cases.
  void begin(const TimedTarget& target) {
    TargetCases cases = {target};
    Attempt base = attempt(cases, Side::base, {});
    cases.most_seconds = limits_after(base);
    Attempt head = attempt(cases, Side::head, {});
    const bool has_failed = !base.failure.empty() || !head.failure.empty();
    if (!has_failed || !try_alone(cases, base, head)) add_all(cases, base, head);
    targets_.push_back(std::move(cases));
  }

  void screen_all() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < all_.cases.size(); ++i)
      if (!is_screened(i)) open.push_back(i);
    for (;;) {
      expect(open, [&](std::size_t i) { return expected_pairs(i); });
      if (open.empty()) return;
      take_more(open, &PairedSamples::screening);
      std::erase_if(open, [&](std::size_t i) { return is_screened(i); });
    }
  }

  void confirm_suspects() {
    std::map<std::size_t, Look> suspects;
    for (std::size_t i = 0; i < all_.cases.size(); ++i) {
      if (!is_timed(i) || all_.cases[i].screening.empty()) continue;
      const Look look = screen(all_.cases[i], all_, rules_, options_.calibration);
      if (look.call == Call::worse) suspects.emplace(i, look);
    }
    const auto is_open = [&](std::size_t i) {
      const PairedSamples& one = all_.cases[i];
      const TimeRules& rules = time_rules_of(rules_, one.case_name);
      if (!one.is_comparable()) return false;
      if (one.confirmation.empty()) return true;
      const Look& screening = suspects.at(i);
      const Look look = confirm(one, screening, static_cast<int>(suspects.size()), rules_, all_.seed);
      return half_width(look.log_ratio) > wanted_half_width(screening, rules) &&
             static_cast<int>(one.confirmation.size()) < rules.at_most;
    };
    std::vector<std::size_t> open;
    for (const auto& [i, look] : suspects)
      if (is_open(i)) open.push_back(i);
    for (;;) {
      expect(open, [&](std::size_t i) { return next(i, static_cast<int>(all_.cases[i].confirmation.size())); });
      if (open.empty()) return;
      take_more(open, &PairedSamples::confirmation);
      std::erase_if(open, [&](std::size_t i) { return !is_open(i); });
    }
  }

 private:
  using Pairs = std::vector<Pair> PairedSamples::*;

  std::size_t draw(std::size_t count) { return static_cast<std::size_t>(random_() >> 32) * count >> 32; }

  const TimeRules& time_rules(std::size_t i) const { return time_rules_of(rules_, all_.cases[i].case_name); }

  bool is_timed(std::size_t i) const {
    const PairedSamples& one = all_.cases[i];
    return one.is_comparable() && is_gated(rules_, Layer::time, one.case_name, one.figure);
  }

  bool is_screened(std::size_t i) const {
    const PairedSamples& one = all_.cases[i];
    const auto pairs = static_cast<int>(one.screening.size());
    if (!one.is_comparable()) return true;
    if (!is_timed(i)) return pairs >= pairs_of_counters;
    if (pairs < time_rules(i).at_least) return false;
    return pairs >= time_rules(i).at_most || screen(one, all_, rules_, options_.calibration).call != Call::open;
  }

  template <class ExpectedPairs>
  void expect(const std::vector<std::size_t>& open, const ExpectedPairs& pairs_of) {
    open_ = open.size();
    expected_.assign(all_.cases.size(), 0);
    for (const std::size_t i : open) expected_[i] = pairs_of(i);
  }

  /// The pairs after the next look.
  int next(std::size_t i, int pairs) const {
    if (!is_timed(i)) return pairs_of_counters;
    const TimeRules& rules = time_rules(i);
    const int wanted = next_look(pairs, rules);
    if (!all_.is_rebuilt) return wanted;
    const int step = pairs_of_layout(rules);
    return std::max(rules.layouts, (wanted + step - 1) / step) * step;
  }

  Attempt attempt(const TargetCases& cases, Side side, const std::set<std::string>& names, int layout = 0) {
    Attempt result;
    const RunRequest request = {side, draw(most_padding), names, layout, limit_of(cases, side)};
    const auto begin = std::chrono::steady_clock::now();
    try {
      result.measured = cases.target.run(request);
    } catch (const ProgramFailed& failure) {
      result.failure = failure.what();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

  double limit_of(const TargetCases& cases, Side side) const {
    return options_.most_seconds > 0 ? options_.most_seconds : cases.most_seconds[side == Side::head];
  }

  /// The head may take far longer than the base, but not forever.
  static std::array<double, 2> limits_after(const Attempt& base) {
    if (!base.failure.empty()) return {};
    const double most = std::max(least_patience, patience * base.seconds);
    return {most, most};
  }

  /// Runs each case by itself with both programs, so that a crash of one does not hide the others.
  /// \return  does the program say which cases it has?
  bool try_alone(TargetCases& cases, const Attempt& whole_base, const Attempt& whole_head) {
    if (!cases.target.list) return false;
    std::array<std::set<std::string>, 2> names;
    for (const auto& [whole, side] : {std::pair(&whole_base, Side::base), std::pair(&whole_head, Side::head)}) {
      for (const auto& [name, measured] : whole->measured) names[side == Side::head].insert(name);
      for (const std::string& name : cases.target.list(side)) names[side == Side::head].insert(name);
    }
    std::set<std::string> either = names[0];
    either.insert(names[1].begin(), names[1].end());
    if (either.empty()) return false;
    for (const std::string& name : either) {
      std::array<Attempt, 2> alone = {whole_base, whole_head};
      for (const Side side : {Side::base, Side::head})
        if (!names[side == Side::head].empty())
          alone[side == Side::head] =
              names[side == Side::head].contains(name) ? attempt(cases, side, {name}) : Attempt();
      add(cases, name, alone[0], alone[1]);
    }
    return true;
  }

  void add_all(TargetCases& cases, const Attempt& base, const Attempt& head) {
    std::set<std::string> names;
    for (const Attempt* one : {&base, &head})
      for (const auto& [name, measured] : one->measured) names.insert(name);
    if (names.empty()) names.insert(cases.target.name);
    for (const std::string& name : names) add(cases, name, base, head);
  }

  /// The failure of a case in an attempt; empty: none.
  static std::string failure_in(const Attempt& one, const std::string& name) {
    const auto found = one.measured.find(name);
    return found == one.measured.end() ? one.failure : found->second.failure;
  }

  void add(TargetCases& cases, const std::string& name, const Attempt& base, const Attempt& head) {
    const TimedTarget& target = cases.target;
    const bool is_wanted = is_gated(rules_, Layer::time, name, target.figure) ||
                           (rules_.layers.contains(Layer::exact) && matches(rules_.exact.cases, name));
    if (!is_wanted) return;
    const auto known = std::ranges::find_if(
        all_.cases, [&](const PairedSamples& one) { return one.case_name == name && one.figure == target.figure; });
    const auto i = static_cast<std::size_t>(known - all_.cases.begin());
    if (known == all_.cases.end()) all_.cases.emplace_back();
    cases.samples.push_back(i);
    PairedSamples& one = all_.cases[i];
    one.case_name = name;
    one.figure = target.figure;
    one.base_failure = failure_in(base, name);
    one.head_failure = failure_in(head, name);
    one.in_base_only = !head.measured.contains(name) && one.head_failure.empty();
    one.in_head_only = !base.measured.contains(name) && one.base_failure.empty();
    if (!one.in_head_only) one.base_command = target.command(Side::base, name);
    if (!one.in_base_only) one.head_command = target.command(Side::head, name);
  }

  /// Measures as many pairs of each of these cases as the next look needs.
  void take_more(const std::vector<std::size_t>& wanted, Pairs pairs) {
    for (const TargetCases& cases : targets_) {
      std::vector<std::size_t> some;
      int now = 0, then = 0;
      for (const std::size_t i : cases.samples) {
        if (!std::ranges::binary_search(wanted, i)) continue;
        some.push_back(i);
        now = std::max(now, static_cast<int>((all_.cases[i].*pairs).size()));
        then = std::max(then, next(i, static_cast<int>((all_.cases[i].*pairs).size())));
      }
      for (int n = now; n < then && !some.empty(); ++n) {
        take_pair(cases, some, n, pairs);
        std::erase_if(some, [&](std::size_t i) { return !all_.cases[i].is_comparable(); });
      }
    }
  }

  /// The number of the build for the n-th pair.
  int layout_of(std::size_t i, int n, Pairs pairs) const {
    if (!all_.is_rebuilt) return 0;
    const TimeRules& rules = time_rules(i);
    const int first = pairs == &PairedSamples::screening ? 0 : most_layouts(rules);
    return 1 + first + n / pairs_of_layout(rules) % most_layouts(rules);
  }

  void take_pair(const TargetCases& cases, const std::vector<std::size_t>& some, int n, Pairs pairs) {
    std::set<std::string> names;
    for (const std::size_t i : some) names.insert(all_.cases[i].case_name);
    const int layout = layout_of(some.front(), n, pairs);
    const bool head_first = draw(2) == 1;
    std::array<Attempt, 2> both;
    for (const Side side : head_first ? std::array{Side::head, Side::base} : std::array{Side::base, Side::head})
      both[side == Side::head] = attempt(cases, side, names, layout);
    for (const std::size_t i : some) add_pair(both, {.head_first = head_first, .layout = layout}, pairs, all_.cases[i]);
    if (!both[0].failure.empty() || !both[1].failure.empty()) find_failures(cases, some, both);
    ++pairs_;
    show(pairs);
  }

  static void add_pair(const std::array<Attempt, 2>& both, Pair pair, Pairs pairs, PairedSamples& one) {
    const auto base = both[0].measured.find(one.case_name), head = both[1].measured.find(one.case_name);
    // A case that does not come back would be waited for without end.
    for (const Side side : {Side::base, Side::head})
      if (const Attempt& one_side = both[side == Side::head];
          one_side.failure.empty() && !one_side.measured.contains(one.case_name))
        (side == Side::base ? one.base_failure : one.head_failure) = "did not run again when asked for by its name";
    if (base == both[0].measured.end() || head == both[1].measured.end()) return;
    one.base_failure = base->second.failure;
    one.head_failure = head->second.failure;
    if (one.has_failed()) return;
    pair.base = base->second.seconds;
    pair.head = head->second.seconds;
    (one.*pairs).push_back(pair);
    for (const MeasuredCase* measured : {&base->second, &head->second})
      one.timed_seconds =
          one.timed_seconds == 0 ? measured->timed_seconds : std::min(one.timed_seconds, measured->timed_seconds);
    for (const auto& [name, value] : base->second.counters) one.counters[name].base.push_back(value);
    for (const auto& [name, value] : head->second.counters) one.counters[name].head.push_back(value);
  }

  /// A program that had run these cases failed: finds out on which, and goes on without them. If none fails alone, all
  /// count as failed.
  void find_failures(const TargetCases& cases, const std::vector<std::size_t>& some,
                     const std::array<Attempt, 2>& both) {
    bool is_found = false;
    for (const Side side : {Side::base, Side::head}) {
      const std::string& whole = both[side == Side::head].failure;
      if (whole.empty()) continue;
      for (const std::size_t i : some) {
        if (some.size() == 1) break;
        PairedSamples& one = all_.cases[i];
        const Attempt alone = attempt(cases, side, {one.case_name});
        (side == Side::base ? one.base_failure : one.head_failure) = failure_in(alone, one.case_name);
        is_found = is_found || one.has_failed();
      }
      if (is_found) continue;
      for (const std::size_t i : some) {
        PairedSamples& one = all_.cases[i];
        (side == Side::base ? one.base_failure : one.head_failure) =
            "failed once, after " + std::to_string(one.screening.size() + one.confirmation.size()) +
            " good runs: " + whole;
      }
    }
  }

  void show(Pairs pairs) const {
    if (!options_.progress) return;
    TimeProgress progress = {all_.cases.size() - open_, all_.cases.size(), pairs_, pairs_};
    for (const TargetCases& cases : targets_) {
      int more = 0;
      for (const std::size_t i : cases.samples)
        more = std::max(more, expected_[i] - static_cast<int>((all_.cases[i].*pairs).size()));
      progress.expected += static_cast<std::uint64_t>(more);
    }
    options_.progress(progress);
  }

  /// How many pairs the screening of a case will take, estimated from its noise so far.
  int expected_pairs(std::size_t i) const {
    const auto pairs = static_cast<int>(all_.cases[i].screening.size());
    const TimeRules& rules = time_rules(i);
    if (!is_timed(i)) return pairs_of_counters;
    if (pairs < rules.at_least) return rules.at_least;
    return std::min(pairs_for_verdict(screen(all_.cases[i], all_, rules_, options_.calibration), pairs, rules),
                    rules.at_most);
  }

  const Rules& rules_;
  const MeasureOptions& options_;
  SampleSet& all_;
  std::mt19937_64 random_;
  std::vector<TargetCases> targets_;
  // For the progress:
  std::uint64_t pairs_ = 0;
  std::size_t open_ = 0;       ///< cases
  std::vector<int> expected_;  ///< pairs of each case in the current phase; 0 if it is decided
};

}  // namespace

double clock_step() {
  using Clock = std::chrono::steady_clock;
  constexpr int readings = 1000;
  Clock::duration least = std::chrono::milliseconds(1);
  for (int i = 0; i < readings; ++i) {
    const auto begin = Clock::now();
    auto end = begin;
    while (end == begin) end = Clock::now();
    least = std::min(least, end - begin);
  }
  return std::chrono::duration<double>(least).count();
}

void measure_times(std::span<const TimedTarget> targets, const Rules& rules, const MeasureOptions& options,
                   SampleSet& samples) {
  Measurement measurement(rules, options, samples);
  for (const TimedTarget& target : targets) measurement.begin(target);
  measurement.screen_all();
  measurement.confirm_suspects();
  samples.is_finished = true;
}

}  // namespace ccdt::gate
