#include "reports/interior_points_report.h"

#include <array>

#include "bench/run_record.h"
#include "reports/experiment_parts.h"
#include "reports/numbers.h"
#include "reports/text_table.h"

namespace ccdt {
namespace {

constexpr std::array rules = {InteriorRule::paper, InteriorRule::no_spheres, InteriorRule::no_distances};

std::string words_of(const InteriorCase& c) {
  return c.input + (c.edge_length > 0 ? " at " + rounded(c.edge_length) : "");
}

TextTable sums(const InteriorPoints& points) {
  TextTable cells = {{"rule", "lattice", "cases", "interior vertices", "dropped", "cases with drops"}};
  const auto add = [&](InteriorRule rule, std::string_view lattice, const InteriorSummary& s) {
    cells.push_back({std::string(name_of(rule)), std::string(lattice), with_separators(s.cases),
                     with_separators(s.placed), with_separators(s.dropped), with_separators(s.harmed)});
  };
  for (const InteriorRule rule : rules) {
    for (const Lattice lattice : {Lattice::fcc, Lattice::bcc, Lattice::sc})
      add(rule, name_of(lattice), summarize(points.cases, rule, lattice));
    add(rule, "all", summarize(points.cases, rule));
  }
  return cells;
}

/// The cases in which a point did harm.
TextTable harms(const InteriorPoints& points) {
  TextTable cells = {{"input", "rule", "lattice", "interior vertices", "dropped"}};
  for (const InteriorCase& c : points.cases)
    if (c.dropped > 0)
      cells.push_back({words_of(c), std::string(name_of(c.rule)), std::string(name_of(c.lattice)),
                       with_separators(c.placed), with_separators(c.dropped)});
  return cells;
}

std::vector<std::string> verdict(const InteriorPoints& points) {
  std::vector<std::string> lines;
  for (const InteriorRule rule : rules) {
    const InteriorSummary s = summarize(points.cases, rule);
    const std::string rule_words = "Rule \"" + std::string(name_of(rule)) + "\": ";
    if (s.cases == 0)
      lines.push_back(rule_words + "no case to judge by");
    else if (s.harmed == 0)
      lines.push_back(rule_words + "no point did harm in " + with_separators(s.cases) + " cases with " +
                      with_separators(s.placed) + " interior vertices");
    else
      lines.push_back(rule_words + "points do harm: " + with_separators(s.dropped) + " points of " +
                      with_separators(s.placed + s.dropped) + " would have destroyed a protected edge, in " +
                      with_separators(s.harmed) + " of " + with_separators(s.cases) + " cases");
  }
  return lines;
}

std::vector<std::string> complaints(const InteriorPoints& points) {
  std::vector<std::string> lines;
  for (const InteriorCase& c : points.cases)
    if (c.status != RunStatus::ok)
      lines.push_back(words_of(c) + ", " + std::string(name_of(c.lattice)) + ", " + std::string(name_of(c.rule)) +
                      ": " + std::string(name_of(c.status)) + ": " + c.reason);
  return lines;
}

constexpr const char* title = "Interior points: do they never harm existence?";

}  // namespace

std::string to_terminal(const InteriorPoints& points) {
  std::string text = std::string(title) + "\n\n" + to_terminal(sums(points)) + "\n";
  const TextTable harmed = harms(points);
  if (harmed.size() > 1) text += to_terminal(harmed) + "\n";
  return text + terminal_section("What this says", verdict(points)) +
         terminal_section("What went wrong", complaints(points));
}

std::string to_markdown(const InteriorPoints& points) {
  std::string text = "# " + std::string(title) + "\n\n" + to_markdown(sums(points)) + "\n";
  const TextTable harmed = harms(points);
  if (harmed.size() > 1) text += to_markdown(harmed) + "\n";
  return text + section("What this says", verdict(points)) + section("What went wrong", complaints(points)) +
         closing_sections(interior_points_definitions(), points.how);
}

}  // namespace ccdt
