#include "bench/gate/judge_times.h"

#include <algorithm>
#include <cmath>

#include "bench/gate/compare.h"
#include "bench/run/numbers.h"

namespace ccdt::gate {
namespace {

using bench::percent;

constexpr const char* skipped = "skipped";  ///< what Google Benchmark says of a benchmark that did not want to run

double median_of(std::span<const Pair> pairs, Side side) {
  return bench::median(seconds_of(pairs, side));
}

std::string pairs_text(std::size_t pairs) {
  return bench::with_separators(pairs) + (pairs == 1 ? " pair" : " pairs");
}

std::string slowdown(double log_ratio) {
  return percent(std::expm1(log_ratio));
}

/// Where a threshold comes from, unless it is the relative one of the rules.
std::string reason_words(const Threshold& threshold) {
  switch (threshold.reason) {
    case ThresholdReason::relative:
      return "";
    case ThresholdReason::absolute:
      return " (the absolute threshold of the rules)";
    case ThresholdReason::clock:
      return " (the step of the clock)";
    case ThresholdReason::noise:
      return " (what an unchanged program reaches, by the calibration)";
    case ThresholdReason::layout:
      break;
  }
  return " (what two builds of one source differ by; --rebuild lowers it)";
}

/// What it would take to decide a case.
std::string remedy_words(const PairedSamples& one, const Look& look, std::size_t pairs, const TimeRules& rules) {
  if (is_blunt(look.threshold))
    return look.threshold.reason == ThresholdReason::absolute
               ? "set time.absolute_seconds of the rules to less than a tenth of the time"
           : look.threshold.reason == ThresholdReason::clock
               ? "measure more iterations at once (--benchmark_min_time): the clock counts in steps of " +
                     bench::rounded(1e9 * look.threshold.value * one.timed_seconds / 2) + " ns"
               : "a quieter machine, or --rebuild";
  return "about " + pairs_text(static_cast<std::size_t>(pairs_for_verdict(look, static_cast<int>(pairs), rules))) +
         " would decide it (time.at_most of the rules is " + std::to_string(rules.at_most) + "), or a quieter machine";
}

std::string undecided_words(const PairedSamples& one, const Look& look, std::size_t pairs, const TimeRules& rules) {
  if (is_blunt(look.threshold))
    return "the threshold is " + slowdown(look.threshold.value) + reason_words(look.threshold) + "; " +
           remedy_words(one, look, pairs, rules);
  return "after " + pairs_text(pairs) + ", a slowdown by " + slowdown(look.log_ratio.high) +
         " is possible, and one beyond " + slowdown(look.threshold.limit) + " must be excluded; " +
         remedy_words(one, look, pairs, rules);
}

JudgedFigure judge_look(const PairedSamples& one, std::span<const Pair> pairs, const Look& look, double confidence,
                        const TimeRules& rules) {
  JudgedFigure judged;
  judged.name = one.figure;
  judged.case_name = one.case_name;
  judged.layer = Layer::time;
  judged.base = median_of(pairs, Side::base);
  judged.head = median_of(pairs, Side::head);
  const auto& [value, low, high] = look.log_ratio;
  judged.ratio = std::exp(value);
  judged.interval = bench::Estimate{std::exp(value), std::exp(low), std::exp(high)};
  judged.limit = std::expm1(look.threshold.limit);
  judged.smallest_found = std::expm1(smallest_found(look, pairs.size(), confidence, rules));
  judged.badness = value;
  judged.command = one.head_command;
  if (look.call != Call::open) return judged;
  judged.verdict = Judgment::undecided;
  judged.words = undecided_words(one, look, pairs.size(), rules);
  return judged;
}

JudgedFigure judge_screened(const PairedSamples& one, const Look& look, const TimeRules& rules) {
  JudgedFigure judged = judge_look(one, one.screening, look, screening_confidence(rules), rules);
  if (look.call == Call::worse) {  // the measurement was stopped before it could be confirmed
    judged.verdict = Judgment::undecided;
    judged.words = "slower by more than " + slowdown(look.threshold.value) + ", but not confirmed with fresh pairs";
  } else if (look.call == Call::not_worse) {
    judged.changed = look.log_ratio.high < -look.threshold.value;
    judged.words = judged.changed
                       ? "faster by more than " + slowdown(look.threshold.value)
                       : "a slowdown by more than " + slowdown(std::max(look.log_ratio.high, look.threshold.value)) +
                             " is excluded" + reason_words(look.threshold);
  }
  return judged;
}

JudgedFigure judge_suspect(const PairedSamples& one, const Look& look, double confidence, const TimeRules& rules) {
  JudgedFigure judged = judge_look(one, one.confirmation, look, confidence, rules);
  const std::string threshold = slowdown(look.threshold.value);
  const std::string afresh = pairs_text(one.confirmation.size()) + " afresh";
  if (look.call == Call::worse) {
    judged.verdict = Judgment::worse;
    judged.changed = true;
    judged.words = "slower by more than " + threshold + reason_words(look.threshold) + ", and again in " + afresh;
  } else if (look.call == Call::not_worse) {
    judged.words = "slower by more than " + threshold + " at first, but not in " + afresh;
  }
  return judged;
}

JudgedFigure judge_failure(const PairedSamples& one) {
  JudgedFigure judged;
  judged.name = "status";
  judged.case_name = one.case_name;
  judged.layer = Layer::time;
  const bool base_failed = !one.base_failure.empty(), head_failed = !one.head_failure.empty();
  judged.base_text = base_failed ? "failed" : "ok";
  judged.head_text = head_failed ? "failed" : "ok";
  judged.changed = base_failed != head_failed;
  judged.is_gated = one.base_failure != skipped || one.head_failure != skipped;
  judged.verdict = base_failed ? Judgment::incomparable : Judgment::worse;
  judged.badness = std::numeric_limits<double>::max();
  judged.command = head_failed ? one.head_command : one.base_command;
  if (base_failed && head_failed)
    judged.words = one.base_failure == one.head_failure
                       ? "both programs fail: " + one.head_failure
                       : "both programs fail; base: " + one.base_failure + "; head: " + one.head_failure;
  else
    judged.words = base_failed ? "the base fails: " + one.base_failure : "the head fails: " + one.head_failure;
  return judged;
}

CaseFigures figures_of(const PairedSamples& one, Side side) {
  CaseFigures figures{one.case_name, side == Side::base ? one.base_command : one.head_command, {}};
  for (const auto& [name, counter] : one.counters) {
    Figure figure{counter_prefix + name, Layer::exact, side == Side::base ? counter.base : counter.head};
    const auto fault = std::ranges::find_if(figure.samples, [](double value) { return !std::isfinite(value); });
    if (fault != figure.samples.end()) {
      figure.text = std::isnan(*fault) ? "NaN" : *fault > 0 ? "Infinity" : "-Infinity";
      figure.samples.clear();
    }
    // A counter that only one program has.
    if (!figure.samples.empty() || !figure.text.empty()) figures.figures.push_back(std::move(figure));
  }
  return figures;
}

/// The counters of all cases that both programs ran.
std::vector<JudgedFigure> judge_counters(const SampleSet& samples, const Rules& rules) {
  Recording base, head;
  base.in_turns = head.in_turns = true;
  for (const PairedSamples& one : samples.cases) {
    if (!one.is_comparable()) continue;
    base.cases.push_back(figures_of(one, Side::base));
    head.cases.push_back(figures_of(one, Side::head));
  }
  return compare_exact(base, head, rules);
}

}  // namespace

std::string correction_words() {
  return "Each case that looks worse is measured again with fresh pairs. With n such cases, the confidence of each new "
         "interval is 1 - (1 - confidence) / n (Bonferroni), however many cases there are in all.";
}

Precision precision_of(const PairedSamples& one, const SampleSet& all, const Rules& rules,
                       const Calibration* calibration) {
  const CaseNoise* noise = calibration ? find_noise(*calibration, one.case_name) : nullptr;
  Precision precision = {one.timed_seconds, all.clock_seconds};
  if (noise != nullptr) precision.noise_floor = noise->noise_floor;
  if (!all.is_rebuilt && !all.is_same_program())
    precision.layout_deviation =
        noise != nullptr && noise->layout_deviation
            ? *noise->layout_deviation
            : time_rules_of(rules, one.case_name).layout_deviation.value_or(usual_layout_deviation(one.figure));
  precision.cases = static_cast<int>(std::ranges::count_if(all.cases, &PairedSamples::is_comparable));
  return precision;
}

Look screen(const PairedSamples& one, const SampleSet& all, const Rules& rules, const Calibration* calibration) {
  const TimeRules& time = time_rules_of(rules, one.case_name);
  const Threshold threshold =
      threshold_of(time, median_of(one.screening, Side::base), precision_of(one, all, rules, calibration));
  return look_at(one.screening, threshold, bootstrap_for(screening_confidence(time), all.seed));
}

Look confirm(const PairedSamples& one, const Look& screening, int suspects, const Rules& rules, std::uint64_t seed) {
  const double confidence = confirmation_confidence(time_rules_of(rules, one.case_name), suspects);
  return look_at(one.confirmation, screening.threshold, bootstrap_for(confidence, seed));
}

std::vector<JudgedFigure> judge_times(const SampleSet& samples, const Rules& rules, const Calibration* calibration) {
  const auto is_suspect = [](const PairedSamples& s) { return !s.confirmation.empty(); };
  const auto suspects = static_cast<int>(std::ranges::count_if(samples.cases, is_suspect));
  std::vector<JudgedFigure> judged;
  for (const PairedSamples& one : samples.cases) {
    const TimeRules& time = time_rules_of(rules, one.case_name);
    const CaseFigures named{one.case_name, one.in_base_only ? one.base_command : one.head_command, {}};
    if (one.has_failed())
      judged.push_back(judge_failure(one));
    else if (one.in_base_only)
      judged.push_back(lost_case(named, Layer::time, rules));
    else if (one.in_head_only)
      judged.push_back(added_case(named, Layer::time));
    else if (!one.screening.empty() && is_gated(rules, Layer::time, one.case_name, one.figure)) {
      const Look screening = screen(one, samples, rules, calibration);
      if (!is_suspect(one) || screening.call != Call::worse)
        judged.push_back(judge_screened(one, screening, time));
      else
        judged.push_back(judge_suspect(one, confirm(one, screening, suspects, rules, samples.seed),
                                       confirmation_confidence(time, suspects), time));
    }
  }
  std::ranges::move(judge_counters(samples, rules), std::back_inserter(judged));
  return judged;
}

}  // namespace ccdt::gate
