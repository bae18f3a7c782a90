#include "reports/verdict_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "bench/results/numbers.h"
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
    return (value < 0 ? "-" : "") + results::with_separators(static_cast<std::uint64_t>(std::abs(value)));
  return results::rounded(value, 6);
}

std::string side_text(const std::optional<double>& number, const std::string& text, const JudgedFigure& figure) {
  constexpr std::size_t most_letters = 16;  // of a fingerprint
  if (!number) return text.size() > most_letters ? text.substr(0, most_letters) + "..." : text;
  return figure.layer == gate::Layer::time ? results::rounded(*number, 4) + " s" : figure_text(*number);
}

std::string percent(double ratio) {
  return (ratio >= 1 ? "+" : "") + results::rounded(100 * (ratio - 1), 3) + "%";
}

/// The change: "+7%", or for sampled figures "+7.01% [+5.2%, +8.9%]".
std::string change_text(const JudgedFigure& figure) {
  if (!figure.ratio || !std::isfinite(*figure.ratio)) return "";
  if (!figure.interval) return figure.changed ? percent(*figure.ratio) : "";
  return percent(*figure.ratio) + " [" + percent(figure.interval->low) + ", " + percent(figure.interval->high) + "]";
}

std::string count_text(const Verdict& verdict, const char* what, const std::function<bool(const JudgedFigure&)>& has) {
  const auto count = static_cast<std::uint64_t>(std::ranges::count_if(verdict.figures, has));
  return count == 0 ? "" : ", " + results::with_separators(count) + " " + what;
}

/// "worse: 3 of 120 figures are worse, 2 undecided, 1 changed for the better or is new"
std::string first_line(const Verdict& verdict) {
  const auto is = [](Judgment judgment) {
    return [judgment](const JudgedFigure& figure) { return figure.verdict == judgment; };
  };
  std::string text = std::string(name_of(verdict.verdict)) + ": " + results::with_separators(verdict.figures.size()) +
                     (verdict.figures.size() == 1 ? " figure" : " figures");
  text += count_text(verdict, "worse", is(Judgment::worse)) +
          count_text(verdict, "undecided", is(Judgment::undecided)) +
          count_text(verdict, "better or new", gate::is_better) +
          count_text(verdict, "not comparable", is(Judgment::incomparable));
  if (verdict.shadow && verdict.verdict != Judgment::passed) text += "; shadow mode, so this passes";
  return text;
}

std::string terminal_line(const JudgedFigure& figure) {
  std::string text = "  " + figure.name + " of " + figure.case_name + ": " +
                     side_text(figure.base, figure.base_text, figure) + " -> " +
                     side_text(figure.head, figure.head_text, figure);
  if (const std::string change = change_text(figure); !change.empty()) text += ", " + change;
  if (!figure.words.empty()) text += ", " + figure.words;
  if (!figure.command.empty()) text += "; repeat: " + figure.command;
  return text + "\n";
}

std::string code(const std::string& text) {
  return text.empty() ? "" : "`" + text + "`";
}

std::string markdown_table(const std::vector<const JudgedFigure*>& figures, std::size_t most_rows) {
  TextTable table = {{"figure", "case", "base", "head", "change", "certainty", "repeat"}};
  for (std::size_t i = 0; i < std::min(most_rows, figures.size()); ++i) {
    const JudgedFigure& figure = *figures[i];
    table.push_back({code(figure.name), code(figure.case_name), side_text(figure.base, figure.base_text, figure),
                     side_text(figure.head, figure.head_text, figure), change_text(figure), figure.words,
                     code(figure.command)});
  }
  return to_markdown(table);
}

std::string the_rest(std::size_t count, std::size_t shown) {
  return count <= shown ? "" : "and " + results::with_separators(count - shown) + " more: see verdict.json";
}

std::vector<std::string> notes_of(const Verdict& verdict) {
  std::vector<std::string> notes = verdict.notes;
  if (!verdict.correction.empty()) notes.push_back(verdict.correction);
  return notes;
}

}  // namespace

std::string to_terminal(const Verdict& verdict, std::size_t most_lines) {
  std::string text = first_line(verdict) + "\n";
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
  return text;
}

std::string to_markdown(const Verdict& verdict) {
  std::string text = "## " + first_line(verdict) + "\n\n" + code(verdict.base) + " -> " + code(verdict.head) + "\n";
  for (const Part& part : parts()) {
    const auto figures = figures_in(part, verdict);
    if (figures.empty()) continue;
    const std::size_t most_rows = part.is_whole ? figures.size() : most_good_rows;
    text += "\n### " + std::string(part.heading) + "\n\n" + markdown_table(figures, most_rows);
    if (const std::string rest = the_rest(figures.size(), most_rows); !rest.empty()) text += "\n" + rest + "\n";
  }
  const std::vector<std::string> notes = notes_of(verdict);
  if (!notes.empty()) text += "\n### Notes\n\n";
  for (const std::string& note : notes) text += "* " + note + "\n";
  return text + "\n";
}

}  // namespace ccdt::reports
