#include "reports/verdict_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bench/run/numbers.h"
#include "reports/result_text.h"

namespace ccdt::reports {
namespace {

using gate::JudgedFigure;
using gate::Judgment;
using gate::Verdict;

constexpr std::size_t most_good_rows = 100;  ///< rows in Markdown for figures that are better or new

/// A kind of figure that is listed.
struct Part {
  const char* heading;
  std::function<bool(const JudgedFigure&)> contains;
  bool is_whole;  ///< lists all of them in Markdown
};

const std::vector<Part>& parts() {
  static const std::vector<Part> all = {
      {"Worse", [](const JudgedFigure& f) { return f.verdict == Judgment::worse; }, true},
      {"Undecided", [](const JudgedFigure& f) { return f.verdict == Judgment::undecided; }, true},
      {"Not comparable", [](const JudgedFigure& f) { return f.is_gated && f.verdict == Judgment::incomparable; }, true},
      {"Changed, and not worse", gate::is_better, false},
  };
  return all;
}

std::vector<const JudgedFigure*> figures_in(const Part& part, const Verdict& verdict) {
  std::vector<const JudgedFigure*> figures;
  for (const JudgedFigure& figure : verdict.figures)
    if (part.contains(figure)) figures.push_back(&figure);
  return figures;
}

std::string figure_text(double value) {
  if (!std::isfinite(value)) return "infinite";
  if (value == std::floor(value) && std::abs(value) < 1e15)
    return (value < 0 ? "-" : "") + bench::with_separators(static_cast<std::uint64_t>(std::abs(value)));
  return bench::rounded(value, 6);
}

std::string seconds_text(double seconds) {
  static constexpr std::pair<double, const char*> units[] = {{1, " s"}, {1e-3, " ms"}, {1e-6, " us"}, {1e-9, " ns"}};
  for (const auto& [size, name] : units)
    if (seconds >= size || size == 1e-9) return bench::rounded(seconds / size, 4) + name;
  return "";
}

std::string side_text(const std::optional<double>& number, const std::string& text, const JudgedFigure& figure) {
  constexpr std::size_t most_letters = 16;  // of a fingerprint
  if (!number) return text.size() > most_letters ? text.substr(0, most_letters) + "..." : text;
  return figure.layer == gate::Layer::time ? seconds_text(*number) : figure_text(*number);
}

std::string percent(double ratio) {
  return (ratio >= 1 ? "+" : "") + bench::rounded(100 * (ratio - 1), 3) + "%";
}

/// The change: "+7%", or for sampled figures "+7.01% [+5.2%, +8.9%]".
std::string change_text(const JudgedFigure& figure) {
  if (!figure.ratio || !std::isfinite(*figure.ratio)) return "";
  if (!figure.interval) return figure.changed ? percent(*figure.ratio) : "";
  return percent(*figure.ratio) + " [" + percent(figure.interval->low) + ", " + percent(figure.interval->high) + "]";
}

std::string count_text(const Verdict& verdict, const char* what, const std::function<bool(const JudgedFigure&)>& has) {
  const auto count = static_cast<std::uint64_t>(std::ranges::count_if(verdict.figures, has));
  return count == 0 ? "" : ", " + bench::with_separators(count) + " " + what;
}

/// "passed: 120 figures, 1 better or new; judged: exact, time; not judged: instructions (nothing was measured)"
std::string first_line(const Verdict& verdict) {
  const auto is = [](Judgment judgment) {
    return [judgment](const JudgedFigure& figure) { return figure.is_gated && figure.verdict == judgment; };
  };
  const auto gated = static_cast<std::uint64_t>(std::ranges::count_if(verdict.figures, &JudgedFigure::is_gated));
  std::string text = std::string(name_of(verdict.verdict)) + ": " + bench::with_separators(gated) +
                     (gated == 1 ? " figure" : " figures");
  text += count_text(verdict, "worse", is(Judgment::worse)) +
          count_text(verdict, "undecided", is(Judgment::undecided)) +
          count_text(verdict, "better or new", gate::is_better) +
          count_text(verdict, "not comparable", is(Judgment::incomparable)) +
          count_text(verdict, "not gated", [](const JudgedFigure& figure) { return !figure.is_gated; });
  if (verdict.shadow && verdict.verdict != Judgment::passed) text += "; shadow mode, so this passes";
  return text;
}

/// Which layers were judged, and why others were not.
std::string layers_line(const Verdict& verdict) {
  std::vector<std::string> judged, others;
  for (const gate::LayerReport& layer : verdict.layers)
    if (layer.is_judged)
      judged.emplace_back(name_of(layer.layer));
    else
      others.push_back(std::string(name_of(layer.layer)) + " (" + layer.why + ")");
  std::string text = "judged: " + (judged.empty() ? "nothing" : bench::joined(judged));
  if (!others.empty()) text += "; not judged: " + bench::joined(others);
  if (verdict.rules.layers_are_chosen && !others.empty()) text += ", though asked for";
  return text;
}

std::string name_for_people(const JudgedFigure& figure) {
  if (figure.name == "wall") return "wall time";
  return figure.name == "real_time" || figure.name == "cpu_time"
             ? figure.name.substr(0, figure.name.find('_')) + " time"
             : figure.name;
}

std::string terminal_line(const JudgedFigure& figure) {
  std::string text = "  " + figure.case_name + ", " + name_for_people(figure) + ": " +
                     side_text(figure.base, figure.base_text, figure) + " -> " +
                     side_text(figure.head, figure.head_text, figure);
  if (const std::string change = change_text(figure); !change.empty()) text += ", " + change;
  if (!figure.words.empty()) text += "; " + figure.words;
  if (!figure.command.empty()) text += "; repeat: " + figure.command;
  return text + "\n";
}

/// Is it one of the many figures of a report of `ccdt mesh`, which are counted in one row?
bool is_one_of_many(const JudgedFigure& figure) {
  if (gate::is_about_the_end(figure)) return figure.verdict == Judgment::passed && !figure.changed;
  return figure.layer != gate::Layer::time && !figure.name.starts_with(gate::counter_prefix) &&
         figure.name != "instructions.total" && figure.name != "instructions.system_calls" &&
         figure.name != "instructions.allocations" && figure.name != "instructions.mesh";
}

std::string judgment_text(const JudgedFigure& figure) {
  if (!figure.is_gated) return "not gated";
  return gate::is_better(figure) ? "better" : std::string(name_of(figure.verdict));
}

std::vector<std::string> row_of(const JudgedFigure& figure) {
  std::string ratio, interval;
  if (figure.ratio && std::isfinite(*figure.ratio)) ratio = bench::rounded(*figure.ratio, 4);
  if (figure.interval)
    interval = "[" + bench::rounded(figure.interval->low, 4) + ", " + bench::rounded(figure.interval->high, 4) + "]";
  const std::string found = figure.smallest_found                ? bench::percent(*figure.smallest_found)
                            : figure.layer == gate::Layer::exact ? "any"
                                                                 : "";
  return {figure.case_name,
          name_for_people(figure),
          side_text(figure.base, figure.base_text, figure),
          side_text(figure.head, figure.head_text, figure),
          ratio,
          interval,
          found,
          judgment_text(figure)};
}

/// "98 figures: 1 worse, 2 better"
std::string counts_text(const std::vector<const JudgedFigure*>& figures) {
  std::map<std::string, int> counts;
  for (const JudgedFigure* figure : figures)
    if (const std::string judgment = judgment_text(*figure); judgment != "passed") ++counts[judgment];
  std::vector<std::string> words;
  for (const auto& [judgment, count] : counts) words.push_back(std::to_string(count) + " " + judgment);
  return words.empty() ? "passed" : bench::joined(words);
}

/// All cases, the worst first: a row for each time, counter and total, and one for all other figures of a layer.
TextTable all_cases(const Verdict& verdict) {
  TextTable table = {{"case", "figure", "base", "head", "ratio", "interval", "smallest slowdown found", "verdict"}};
  std::map<std::pair<std::string, gate::Layer>, std::vector<const JudgedFigure*>> many;
  for (const JudgedFigure& figure : verdict.figures)
    if (is_one_of_many(figure)) many[{figure.case_name, figure.layer}].push_back(&figure);
  for (const JudgedFigure& figure : verdict.figures) {
    if (!is_one_of_many(figure)) {
      table.push_back(row_of(figure));
      continue;
    }
    const auto all = many.extract({figure.case_name, figure.layer});
    if (all.empty()) continue;
    const std::string count = std::to_string(all.mapped().size()) + (all.mapped().size() == 1 ? " figure" : " figures");
    table.push_back({figure.case_name, count + ", " + std::string(name_of(figure.layer)), "", "", "", "",
                     figure.layer == gate::Layer::exact ? "any" : bench::percent(verdict.rules.instructions.relative),
                     counts_text(all.mapped())});
  }
  return table;
}

/// What the limits of times are.
std::string limits_line(const Verdict& verdict) {
  const gate::TimeRules& time = verdict.rules.time;
  const bool has_times =
      std::ranges::any_of(verdict.figures, [](const JudgedFigure& f) { return f.limit.has_value(); });
  if (!has_times) return "";
  return "a time is worse if it is slower by more than " + bench::percent(time.relative) +
         ", and passes if a slowdown by more than " + bench::percent(time.relative + time.largest_noise) +
         " is excluded, with " + bench::percent(time.confidence) +
         " confidence; a case whose clock, noise or builds allow less has a higher limit";
}

std::string markdown_table(const std::vector<const JudgedFigure*>& figures, std::size_t most_rows) {
  TextTable table = {{"figure", "case", "base", "head", "change", "certainty", "repeat"}};
  for (std::size_t i = 0; i < std::min(most_rows, figures.size()); ++i) {
    const JudgedFigure& figure = *figures[i];
    table.push_back({figure.name, figure.case_name, side_text(figure.base, figure.base_text, figure),
                     side_text(figure.head, figure.head_text, figure), change_text(figure), figure.words,
                     figure.command});
  }
  return to_markdown(table, {0, 1, 6});
}

std::string the_rest(std::size_t count, std::size_t shown) {
  return count <= shown ? "" : "and " + bench::with_separators(count - shown) + " more: see verdict.json";
}

std::vector<std::string> notes_of(const Verdict& verdict) {
  std::vector<std::string> notes = verdict.notes;
  if (std::string limits = limits_line(verdict); !limits.empty()) notes.push_back(std::move(limits));
  if (!verdict.correction.empty()) notes.push_back(verdict.correction);
  return notes;
}

}  // namespace

std::string to_terminal(const Verdict& verdict, std::size_t most_lines) {
  std::string text = first_line(verdict) + "\n" + layers_line(verdict) + "\n";
  for (const Part& part : parts()) {
    const auto figures = figures_in(part, verdict);
    if (figures.empty()) continue;
    text += "\n" + std::string(part.heading) + ":\n";
    for (std::size_t i = 0; i < std::min(most_lines, figures.size()); ++i) text += terminal_line(*figures[i]);
    if (const std::string rest = the_rest(figures.size(), most_lines); !rest.empty()) text += "  " + rest + "\n";
  }
  const std::vector<std::string> notes = notes_of(verdict);
  if (!notes.empty()) text += "\nNotes:\n";
  for (const std::string& note : notes) text += "  " + note + "\n";
  if (!verdict.figures.empty()) text += "\n" + to_terminal(all_cases(verdict));
  return text;
}

std::string to_markdown(const Verdict& verdict) {
  std::string text = "## " + first_line(verdict) + "\n\n" + markdown_text(layers_line(verdict)) + "\n\n" +
                     markdown_code(verdict.base) + " -> " + markdown_code(verdict.head) + "\n";
  for (const Part& part : parts()) {
    const auto figures = figures_in(part, verdict);
    if (figures.empty()) continue;
    const std::size_t most_rows = part.is_whole ? figures.size() : most_good_rows;
    text += "\n### " + std::string(part.heading) + "\n\n" + markdown_table(figures, most_rows);
    if (const std::string rest = the_rest(figures.size(), most_rows); !rest.empty()) text += "\n" + rest + "\n";
  }
  const std::vector<std::string> notes = notes_of(verdict);
  if (!notes.empty()) text += "\n### Notes\n\n";
  for (const std::string& note : notes) text += "* " + markdown_text(note) + "\n";
  if (verdict.figures.empty()) return text + "\n";
  return text + "\n### All cases\n\n" + to_markdown(all_cases(verdict), {0}) + "\n";
}

}  // namespace ccdt::reports
