#include "bench/gate/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "bench/gate/paired_samples.h"
#include "bench/run/numbers.h"

namespace ccdt::gate {
namespace {

constexpr double badness_of_lost = std::numeric_limits<double>::max();  ///< sorts lost figures before all others

bool is_whole(double value) {
  return value == std::floor(value);
}

/// Are they equal, up to the last bits if a figure is not a whole number?
bool are_equal(double a, double b, double relative) {
  if (a == b) return true;
  if ((is_whole(a) && is_whole(b)) || !std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

JudgedFigure start(const Figure& base, const Figure& head, const CaseFigures& one) {
  JudgedFigure judged;
  judged.name = head.name;
  judged.case_name = one.name;
  judged.layer = head.layer;
  judged.command = one.command;
  judged.base_text = base.text;
  judged.head_text = head.text;
  if (!base.samples.empty()) judged.base = bench::median(base.samples);
  if (!head.samples.empty()) judged.head = bench::median(head.samples);
  if (judged.base && judged.head && *judged.base != 0) judged.ratio = *judged.head / *judged.base;
  return judged;
}

/// A figure or case that only one of the recordings has.
JudgedFigure lost(const Figure& base, const CaseFigures& one) {
  JudgedFigure judged = start(base, {base.name, base.layer, {}, "missing"}, one);
  judged.verdict = Judgment::worse;
  judged.changed = true;
  judged.badness = badness_of_lost;
  judged.words = "is in the base only";
  return judged;
}

JudgedFigure added(const Figure& head, const CaseFigures& one) {
  JudgedFigure judged = start({head.name, head.layer, {}, "missing"}, head, one);
  judged.changed = true;
  judged.is_gated = false;
  judged.words = "is new";
  return judged;
}

bool agree_among_runs(const Figure& figure, double relative) {
  return std::ranges::all_of(figure.samples,
                             [&](double sample) { return are_equal(sample, figure.samples.front(), relative); }) &&
         figure.text.find(" or ") == std::string::npos;
}

/// The loss of the head as the logarithm of a ratio; infinite if the base is 0.
double badness_of(double base, double head) {
  if (base == 0 || head == 0 || !std::isfinite(base) || !std::isfinite(head) || (base < 0) != (head < 0))
    return std::numeric_limits<double>::infinity();
  return std::abs(std::log(head / base));
}

void judge_numbers(const ExactRules& rules, JudgedFigure& judged) {
  const double base = *judged.base, head = *judged.head;
  if (are_equal(base, head, rules.relative)) return;
  judged.changed = true;
  const Better better = better_of(rules, judged.name);
  const bool is_loss = better == Better::same || (better == Better::fewer ? head > base : head < base);
  const double tolerance = tolerance_of(rules, judged.name);
  const bool is_tolerated = std::abs(head - base) <= tolerance * std::abs(base);
  if (!is_loss) {
    judged.words = "better";
  } else if (is_tolerated) {
    judged.words = "worse by less than the tolerance of " + bench::rounded(100 * tolerance) + "%";
  } else {
    judged.verdict = Judgment::worse;
    judged.words = better == Better::same ? "must stay the same; exact" : "exact";
    judged.badness = std::min(badness_of(base, head), badness_of_lost / 2);
  }
}

void judge_texts(JudgedFigure& judged) {
  if (judged.base_text == judged.head_text) return;
  judged.changed = true;
  judged.verdict = Judgment::worse;
  judged.words = "must stay the same; exact";
}

/// Lists a figure that is not gated, with the reason.
JudgedFigure not_gated(JudgedFigure judged, const std::string& why) {
  judged.verdict = Judgment::incomparable;
  judged.is_gated = false;
  judged.words = why;
  return judged;
}

/// A counter that a rule names, and that differs between runs: by the ratios of pairs.
void judge_by_pairs(const Figure& base, const Figure& head, const ExactRules& rules, JudgedFigure& judged) {
  std::vector<double> losses;
  const double sign = better_of(rules, judged.name) == Better::more ? -1 : 1;
  for (std::size_t i = 0; i < base.samples.size(); ++i)
    if (base.samples[i] > 0 && head.samples[i] > 0)
      losses.push_back(sign * std::log(head.samples[i] / base.samples[i]));
  const double tolerance = std::log1p(tolerance_of(rules, judged.name));
  if (losses.size() < std::max<std::size_t>(2, base.samples.size())) {
    judged.verdict = Judgment::incomparable;
    judged.words = "is not positive in all runs, so there are no ratios";
    return;
  }
  const bench::Estimate loss = bench::trimmed_mean_estimate(losses, trimmed_share);
  const bool is_turned = sign < 0;
  judged.ratio = std::exp(sign * loss.value);
  judged.interval = bench::Estimate{*judged.ratio, std::exp(is_turned ? -loss.high : loss.low),
                                    std::exp(is_turned ? -loss.low : loss.high)};
  if (loss.low > tolerance) {
    judged.verdict = Judgment::worse;
    judged.changed = true;
    judged.badness = loss.value;
    judged.words = "the whole interval is beyond the tolerance of " + bench::percent(std::expm1(tolerance));
  } else if (loss.high > tolerance) {
    judged.verdict = Judgment::undecided;
    judged.words = "the interval is on both sides of the tolerance of " + bench::percent(std::expm1(tolerance)) +
                   "; a larger tolerance or more pairs would decide it";
  }
}

/// Counters that differ from run to run, or are not whole, are judged only by a rule.
std::optional<JudgedFigure> judge_counter(const Figure& base, const Figure& head, const CaseFigures& one,
                                          const Rules& rules, bool in_turns) {
  const bool is_ruled = has_rule(rules.exact, head.name);
  const bool agrees = agree_among_runs(base, rules.exact.relative);
  if (!base.text.empty() && base.text == head.text)
    return not_gated(start(base, head, one), "is " + base.text + " in both");
  if (!is_ruled && !std::ranges::all_of(base.samples, is_whole))
    return not_gated(start(base, head, one), "is not a whole number, and no rule names it");
  if (!is_ruled && !agrees)
    return not_gated(start(base, head, one), "differs between runs of the base, and no rule names it");
  const bool is_paired =
      in_turns && base.samples.size() == head.samples.size() && base.text.empty() && head.text.empty();
  if (!is_ruled || !is_paired || (agrees && agree_among_runs(head, rules.exact.relative))) return {};
  JudgedFigure judged = start(base, head, one);
  judge_by_pairs(base, head, rules.exact, judged);
  return judged;
}

JudgedFigure judge_exact(const Figure& base, const Figure& head, const CaseFigures& one, const ExactRules& rules) {
  JudgedFigure judged = start(base, head, one);
  if (!agree_among_runs(head, rules.relative) || !agree_among_runs(base, rules.relative)) {
    const bool is_new = agree_among_runs(base, rules.relative);
    judged.verdict = is_new ? Judgment::worse : Judgment::incomparable;
    judged.changed = is_new;
    judged.words = "is not the same in all runs of " + std::string(is_new ? "the head" : "the base");
  } else if (judged.base && judged.head) {
    judge_numbers(rules, judged);
  } else {
    if (base.samples.empty() != head.samples.empty()) judged.base_text = "another type";
    judge_texts(judged);
  }
  return judged;
}

/// A failed case has no other figures. Empty: both succeeded, or both failed.
std::optional<JudgedFigure> judge_status(const CaseFigures& base, const CaseFigures& head) {
  const Figure *then = find_figure(base, "status"), *now = find_figure(head, "status");
  if (then == nullptr || now == nullptr || (then->text == "ok") == (now->text == "ok")) return {};
  JudgedFigure judged = start(*then, *now, head);
  judged.changed = true;
  if (now->text == "ok") {
    judged.words = "better";
    return judged;
  }
  judged.verdict = Judgment::worse;
  judged.badness = badness_of_lost;
  const Figure* kind = find_figure(head, "kind");
  judged.words = kind == nullptr ? "failed" : "failed: " + kind->text;
  return judged;
}

/// A report leaves out counts of work that are 0. The report of an older program has none at all.
bool is_zero_work(const std::string& figure, const CaseFigures& one) {
  const auto is_work = [](const std::string& name) { return name.starts_with("work."); };
  return is_work(figure) && std::ranges::any_of(one.figures, is_work, &Figure::name);
}

bool is_counter(const Figure& figure) {
  return figure.name.starts_with(counter_prefix);
}

void compare_exact_case(const CaseFigures& base, const CaseFigures& head, const Rules& rules, bool in_turns,
                        std::vector<JudgedFigure>& all) {
  if (auto status = judge_status(base, head)) {
    all.push_back(*std::move(status));
    return;
  }
  const auto is_compared = [&](const Figure& figure) {
    return figure.layer == Layer::exact && is_gated(rules, Layer::exact, head.name, figure.name);
  };
  for (const Figure& figure : base.figures) {
    if (!is_compared(figure)) continue;
    const Figure* now = find_figure(head, figure.name);
    auto counter = now != nullptr && is_counter(figure) ? judge_counter(figure, *now, head, rules, in_turns)
                                                        : std::optional<JudgedFigure>();
    if (counter)
      all.push_back(*std::move(counter));
    else if (now != nullptr)
      all.push_back(judge_exact(figure, *now, head, rules.exact));
    else if (is_zero_work(figure.name, head))
      all.push_back(judge_exact(figure, {figure.name, Layer::exact, {0}}, head, rules.exact));
    else
      all.push_back(lost(figure, head));
  }
  for (const Figure& figure : head.figures) {
    if (!is_compared(figure) || find_figure(base, figure.name) != nullptr) continue;
    const bool was_zero = is_zero_work(figure.name, base);
    all.push_back(was_zero ? judge_exact({figure.name, Layer::exact, {0}}, figure, head, rules.exact)
                           : added(figure, head));
  }
}

bool is_gated_case(const Rules& rules, const CaseFigures& one) {
  return std::ranges::any_of(one.figures, [&](const Figure& figure) {
    return figure.layer == Layer::exact && is_gated(rules, Layer::exact, one.name, figure.name);
  });
}

JudgedFigure judge_instructions(const Figure& base, const Figure& head, const CaseFigures& one, const Rules& rules) {
  JudgedFigure judged = start(base, head, one);
  if (!judged.base || !judged.head) return judged;
  const double change = *judged.head - *judged.base;
  const InstructionRules& limits = rules.instructions;
  judged.changed = std::abs(change) > limits.absolute && std::abs(change) > limits.relative * *judged.base;
  if (*judged.base > 0) judged.smallest_found = std::max(limits.relative, limits.absolute / *judged.base);
  if (!judged.changed) return judged;
  if (change < 0) {
    judged.words = "better";
    return judged;
  }
  judged.verdict = Judgment::worse;
  judged.badness = badness_of(*judged.base, *judged.head);
  judged.words = "beyond " + bench::rounded(100 * limits.relative) + "% and " +
                 bench::with_separators(static_cast<std::uint64_t>(limits.absolute)) + " instructions; counted";
  return judged;
}

/// Times that were recorded earlier do not allow a verdict.
std::vector<JudgedFigure> list_times(const Recording& base, const Recording& head, const Rules& rules) {
  std::vector<JudgedFigure> all;
  for (const CaseFigures& one : head.cases) {
    const CaseFigures* then = find_case(base, one.name);
    if (then == nullptr) continue;
    for (const Figure& figure : one.figures) {
      const Figure* before = find_figure(*then, figure.name);
      if (figure.layer != Layer::time || before == nullptr || !is_gated(rules, Layer::time, one.name, figure.name))
        continue;
      all.push_back(not_gated(start(*before, figure, one), "recorded earlier, not measured in turns"));
    }
  }
  return all;
}

/// If each recording has one command, they are compared even if their names differ: "old/run" and "new/run".
Recording with_name_of(const Recording& head, const Recording& base) {
  Recording named = base;
  const bool are_commands = base.kind == Source::hyperfine && head.kind == Source::hyperfine;
  if (are_commands && base.cases.size() == 1 && head.cases.size() == 1) named.cases[0].name = head.cases[0].name;
  return named;
}

bool have_common_case(const Recording& base, const Recording& head) {
  return std::ranges::any_of(base.cases, [&](const CaseFigures& one) { return find_case(head, one.name) != nullptr; });
}

}  // namespace

JudgedFigure lost_case(const CaseFigures& one, Layer layer, const Rules& rules) {
  JudgedFigure judged = lost({case_figure, layer, {}, "measured"}, one);
  if (!matches(rules.may_be_missing, one.name)) return judged;
  judged.verdict = Judgment::passed;
  judged.is_gated = false;
  judged.words = "is in the base only, as the rules allow";
  return judged;
}

JudgedFigure added_case(const CaseFigures& one, Layer layer) {
  return added({case_figure, layer, {}, "measured"}, one);
}

std::string other_conditions(const Recording& base, const Recording& head) {
  std::set<std::string> fields;
  for (const Recording* one : {&base, &head})
    for (const auto& [field, value] : one->identity)
      if (field.starts_with("instructions.")) fields.insert(field);
  const auto value_in = [](const Recording& one, const std::string& field) {
    const auto found = one.identity.find(field);
    return found == one.identity.end() ? std::string("not known") : "'" + found->second + "'";
  };
  for (const std::string& field : fields) {
    const std::string then = value_in(base, field), now = value_in(head, field);
    if (then == now) continue;
    std::string words = field;
    return words.append(" is ").append(then).append(" in the base and ").append(now).append(" in the head");
  }
  return {};
}

std::vector<JudgedFigure> compare_exact(const Recording& base, const Recording& head, const Rules& rules) {
  std::vector<JudgedFigure> all;
  if (!rules.layers.contains(Layer::exact) || !have_common_case(base, head)) return all;
  for (const CaseFigures& one : base.cases) {
    const CaseFigures* now = find_case(head, one.name);
    if (now != nullptr)
      compare_exact_case(one, *now, rules, base.in_turns && head.in_turns, all);
    else if (is_gated_case(rules, one))
      all.push_back(lost_case(one, Layer::exact, rules));
  }
  for (const CaseFigures& one : head.cases)
    if (find_case(base, one.name) == nullptr && is_gated_case(rules, one)) all.push_back(added_case(one, Layer::exact));
  return all;
}

std::vector<JudgedFigure> compare_instructions(const Recording& base, const Recording& head, const Rules& rules) {
  std::vector<JudgedFigure> all;
  if (!rules.layers.contains(Layer::instructions)) return all;
  const std::string difference = other_conditions(base, head);
  for (const CaseFigures& one : head.cases) {
    const CaseFigures* then = find_case(base, one.name);
    if (then == nullptr) continue;
    for (const Figure& figure : one.figures) {
      const Figure* before = find_figure(*then, figure.name);
      if (figure.layer != Layer::instructions || before == nullptr ||
          !is_gated(rules, Layer::instructions, one.name, figure.name))
        continue;
      all.push_back(difference.empty() ? judge_instructions(*before, figure, one, rules)
                                       : not_gated(start(*before, figure, one), difference));
      // A user who asks for this layer must get a verdict on it.
      if (!difference.empty()) all.back().is_gated = rules.layers_are_chosen;
    }
  }
  return all;
}

std::vector<JudgedFigure> compare_recordings(const Recording& recorded, const Recording& head, const Rules& rules) {
  const Recording base = with_name_of(head, recorded);
  std::vector<JudgedFigure> all = compare_exact(base, head, rules);
  for (auto&& some : {compare_instructions(base, head, rules), list_times(base, head, rules)})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ccdt::gate
