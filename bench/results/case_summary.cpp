#include "bench/results/case_summary.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <span>

#include "bench/run/in_parallel.h"
#include "bench/run/median_interval.h"
#include "bench/run/numbers.h"

namespace ccdt::results {
namespace {

/// Records of older programs contain only the status.
std::string kind_of(const RunValues& run) {
  if (const std::string_view kind = text_of(run, "kind"); !kind.empty()) return std::string(kind);
  const std::string_view status = text_of(run, "status");
  return status == "failed" ? "refused" : std::string(status);
}

/// "off" alone means nothing: "face-protection off".
std::string option_words(const std::string& option, const std::string& value) {
  const bool speaks = value != "on" && value != "off" && (value.empty() || std::isalpha(value.front()) != 0) &&
                      value != "none" && value != "all";
  return speaks ? value : option + " " + value;
}

/// Figures of the successful runs.
void add_times(CaseSummary& summary) {
  std::vector<double> samples;
  for (const RunValues* run : summary.counted) {
    if (const auto seconds = number_of(*run, "seconds")) samples.push_back(*seconds);
    summary.peak_bytes = std::max(summary.peak_bytes, number_of(*run, "peak_rss_bytes").value_or(0));
  }
  if (samples.empty()) return;
  summary.seconds = bench::median_estimate(samples, bench::looks_of(summary.of->asked.repetitions));
  if (!summary.seconds->has_interval()) return;
  const double wanted = summary.of->asked.repetitions.until;
  const double most = wanted > 0 ? std::min(wanted, widest_spread) : widest_spread;
  const double spread = bench::relative_spread(*summary.seconds);
  if (spread > most) summary.spread = "spread too wide: " + bench::rounded(100 * spread, 2) + "%";
}

void summarize(CaseSummary& summary) {
  const CaseRuns& of = *summary.of;
  const NumberedRun* first = nullptr;
  for (const NumberedRun& run : of.runs) {
    if (text_of(run.values, "status") != "ok") {
      summary.run = &run.values;
      summary.status = text_of(run.values, "status");
      summary.kind = kind_of(run.values);
      summary.reason = text_of(run.values, "reason");
      summary.runs = {run.file};
      summary.counted.clear();
      return;
    }
    if (first == nullptr) first = &run;
    if (run.number < of.asked.repetitions.warm_up) continue;
    summary.counted.push_back(&run.values);
    summary.runs.push_back(run.file);
  }
  if (first == nullptr) return;
  summary.status = "ok";
  summary.run = summary.counted.empty() ? &first->values : summary.counted.front();
  if (summary.runs.empty()) summary.runs = {first->file};
  add_times(summary);
}

/// The options that have several values among the cases of one of the meshers, by their numbers in the sweep.
std::vector<std::size_t> varying_options(const Sweep& sweep) {
  std::vector<std::size_t> varying;
  for (std::size_t option = 0; option < sweep.options.size(); ++option) {
    std::map<std::string, std::set<std::string>> values;
    for (const CaseRuns& one : sweep.cases) values[one.mesher].insert(one.values[option]);
    if (std::ranges::any_of(values, [](const auto& of_mesher) { return of_mesher.second.size() > 1; }))
      varying.push_back(option);
  }
  return varying;
}

/// The number of series that a chart can distinguish.
constexpr std::size_t most_in_legend = 8;

/// The mesher of a case and some of its options.
std::string series_of(const Sweep& sweep, const CaseRuns& one, std::span<const std::size_t> options) {
  std::string series = one.mesher;
  for (const std::size_t option : options)
    if (const std::string& value = one.values[option]; !value.empty())
      series += " " + option_words(sweep.options[option], value);
  return series;
}

/// As many options as charts can show.
std::span<const std::size_t> options_of_legend(const Sweep& sweep, std::span<const std::size_t> options) {
  std::set<std::string> series;
  for (const CaseRuns& one : sweep.cases) series.insert(series_of(sweep, one, options));
  if (series.size() <= most_in_legend || options.empty()) return options;
  return options_of_legend(sweep, options.first(options.size() - 1));
}

}  // namespace

std::vector<CaseSummary> summarize_cases(const Sweep& sweep) {
  const std::vector<std::size_t> varying = varying_options(sweep);
  const std::span<const std::size_t> in_legend = options_of_legend(sweep, varying);
  std::vector<CaseSummary> summaries(sweep.cases.size());
  bench::in_parallel(summaries.size(), [&](std::size_t i) {
    CaseSummary& summary = summaries[i];
    summary.of = &sweep.cases[i];
    summary.series = series_of(sweep, *summary.of, varying);
    summary.legend = series_of(sweep, *summary.of, in_legend);
    summarize(summary);
  });
  return summaries;
}

std::optional<double> number_of(const CaseSummary& summary, RunField field) {
  return summary.is_run() ? number_of(*summary.run, field) : std::nullopt;
}

std::string_view text_of(const CaseSummary& summary, RunField field) {
  return summary.is_run() ? text_of(*summary.run, field) : std::string_view();
}

}  // namespace ccdt::results
