#include <algorithm>
#include <cmath>

#include "bench/experiments/stars.h"
#include "bench/experiments/termination.h"
#include "bench/results/numbers.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

using Cases = std::vector<const TerminationCase*>;

template <class Chosen>
Cases those(std::span<const TerminationCase> cases, Chosen is_chosen) {
  Cases result;
  for (const TerminationCase& c : cases)
    if (is_chosen(c)) result.push_back(&c);
  return result;
}

std::size_t count(const Cases& cases, Ending ending) {
  return static_cast<std::size_t>(
      std::ranges::count_if(cases, [&](const TerminationCase* c) { return ending_of(*c) == ending; }));
}

bool is_star(const TerminationCase& c) {
  return c.group != "solid" && c.group != "file";
}

std::string degrees_in_words(double degrees) {
  return std::to_string(static_cast<int>(std::lround(degrees)));
}

std::vector<std::string> definitions() {
  std::vector<std::string> all = {
      "The paper, section 2: middle points of missing grazeable edges are inserted repeatedly until none is missing.",
      "It does not say that this ends.",
      "Ended: all grazeable edges of the input are chains of Delaunay edges.",
      "Not ended: the engine stopped, for a piece would have been smaller than 2^-20 of its segment,",
      "or there were a hundred times as many pieces as vertices.",
      "Level: how many splits led to a piece, and one more.",
      "Midpoint is the paper's way (--protection midpoint), shell ours (--protection shell).",
      "Nothing is placed inside (--lattice none), and the meshes are not improved.",
      "In a star, segments or facets meet at one point in the middle of a cube.",
      "Variant 0 has lengths that alternate between 1 and 1 / sqrt 2, the others random ones from 0.4 to 1.6.",
  };
  for (const Star& star : stars()) all.push_back(std::string(star.name) + ": " + std::string(star.what));
  return all;
}

/// Nothing where a run has not come so far.
Cell number_if(bool is_known, double value) {
  return is_known && std::isfinite(value) ? Cell(value) : Cell{};
}

Cell ending_cell(const TerminationCase& c) {
  switch (ending_of(c)) {
    case Ending::ended:
      return "yes";
    case Ending::stopped:
      return "no";
    case Ending::unknown:
      break;
  }
  return {};
}

std::string case_label(const TerminationCase& c) {
  return is_star(c) ? degrees_in_words(c.degrees) + " degrees, variant " + c.input : c.input;
}

std::string words_of(const TerminationCase& c) {
  return is_star(c) ? c.group + ", " + case_label(c) : c.input;
}

/// One row a run.
ResultTable runs_table(const std::string& name, const std::string& title, const Cases& cases) {
  ResultTable table{name,
                    title,
                    {{"group", "input", ColumnKind::label},
                     {"case", "case", ColumnKind::label},
                     {"protection", "protection", ColumnKind::label},
                     {"status", "status", ColumnKind::label},
                     {"smallest_angle", "smallest angle", ColumnKind::figure, "degrees"},
                     {"ended", "ended"},
                     {"steiner_vertices", "Steiner vertices"},
                     {"deepest_level", "deepest level"},
                     {"reason", "reason", ColumnKind::note}}};
  for (const TerminationCase* c : cases) {
    const bool is_ok = c->status == RunStatus::ok;
    table.rows.push_back(
        {{c->group, case_label(*c), std::string(name_of(c->protection)), std::string(name_of(c->status)),
          number_if(true, c->smallest_angle), ending_cell(*c),
          number_if(is_ok, static_cast<double>(c->steiner_vertices)),
          number_if(is_ok, static_cast<double>(c->deepest_level)), c->reason.empty() ? Cell{} : Cell(c->reason)},
         c->runs});
  }
  return table;
}

/// One way of protection over all variants of a star at one angle: in how many it ended, and what it took at most.
void add_summary(const Cases& cases, std::vector<Cell>& cells) {
  double steiner = 0, deepest = 0;
  for (const TerminationCase* c : cases) {
    steiner = std::max(steiner, static_cast<double>(c->steiner_vertices));
    deepest = std::max(deepest, static_cast<double>(c->deepest_level));
  }
  const std::size_t ended = count(cases, Ending::ended);
  cells.emplace_back(static_cast<double>(ended));
  cells.push_back(number_if(ended > 0, steiner));
  cells.push_back(number_if(ended > 0, deepest));
}

ResultTable stars_table(std::span<const TerminationCase> cases) {
  ResultTable table{"stars",
                    "Segments that meet at small angles",
                    {{"star", "star", ColumnKind::label},
                     {"degrees", "angle", ColumnKind::figure, "degrees"},
                     {"cases", "cases"},
                     {"midpoint_ended", "midpoint ended"},
                     {"midpoint_steiner_vertices", "midpoint: most Steiner vertices"},
                     {"midpoint_deepest_level", "midpoint: deepest level"},
                     {"shell_ended", "shell ended"},
                     {"shell_steiner_vertices", "shell: most Steiner vertices"},
                     {"shell_deepest_level", "shell: deepest level"}}};
  std::vector<std::pair<std::string, double>> groups;
  for (const TerminationCase& c : cases) {
    const std::pair group(c.group, c.degrees);
    if (is_star(c) && std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  for (const auto& [star, degrees] : groups) {
    const auto of = [&](Protection protection) {
      return those(cases, [&, &star = star, degrees = degrees](const TerminationCase& c) {
        return c.group == star && c.degrees == degrees && c.protection == protection;
      });
    };
    const Cases by_midpoint = of(Protection::midpoint), by_shell = of(Protection::shell);
    ResultRow row{{star, degrees, static_cast<double>(by_midpoint.size())}};
    add_summary(by_midpoint, row.cells);
    add_summary(by_shell, row.cells);
    for (const Cases& all : {by_midpoint, by_shell})
      for (const TerminationCase* c : all) row.runs.insert(row.runs.end(), c->runs.begin(), c->runs.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string share(std::size_t part, std::size_t whole) {
  return with_separators(part) + " of " + with_separators(whole);
}

/// Where the midpoints of one star ended, and where not.
std::string midpoint_finding(const std::string& star, const Cases& cases) {
  const std::string ended =
      "Midpoint, " + star + ": ended in " + share(count(cases, Ending::ended), cases.size()) + " cases";
  double least = 180, largest_stopped = 0, least_stopped = 180;
  for (const TerminationCase* c : cases) {
    least = std::min(least, c->degrees);
    if (ending_of(*c) != Ending::stopped) continue;
    largest_stopped = std::max(largest_stopped, c->degrees);
    least_stopped = std::min(least_stopped, c->degrees);
  }
  if (largest_stopped == 0) return ended + ", down to " + degrees_in_words(least) + " degrees";
  double least_safe = 180;
  for (const TerminationCase* c : cases)
    if (c->degrees > largest_stopped) least_safe = std::min(least_safe, c->degrees);
  const std::string safe = least_safe < 180 ? "from " + degrees_in_words(least_safe) + " degrees up it always ended"
                                            : "it was safe at no angle";
  return ended + "; " + safe + "; it did not at " + degrees_in_words(largest_stopped) + " to " +
         degrees_in_words(least_stopped) + " degrees";
}

std::vector<std::string> findings_of(std::span<const TerminationCase> cases) {
  std::vector<std::string> findings;
  for (const Star& star : stars()) {
    const Cases of_star = those(
        cases, [&](const TerminationCase& c) { return c.group == star.name && c.protection == Protection::midpoint; });
    if (!of_star.empty()) findings.push_back(midpoint_finding(std::string(star.name), of_star));
  }
  const auto add = [&](const std::string& what, Protection protection, auto is_chosen) {
    const Cases chosen =
        those(cases, [&](const TerminationCase& c) { return c.protection == protection && is_chosen(c); });
    if (!chosen.empty())
      findings.push_back(what + " ended in " + share(count(chosen, Ending::ended), chosen.size()) + " cases");
  };
  add("Midpoint on solids and files", Protection::midpoint, [](const TerminationCase& c) { return !is_star(c); });
  add("Shell on solids and files", Protection::shell, [](const TerminationCase& c) { return !is_star(c); });
  add("Shell on stars", Protection::shell, is_star);
  return findings;
}

}  // namespace

Ending ending_of(const TerminationCase& c) {
  if (c.status == RunStatus::ok) return Ending::ended;
  // The engine's words for its limits; see engine/protection/protect_edges.cpp.
  const bool is_limit = c.status == RunStatus::failed && c.reason.starts_with("a segment cannot be protected");
  return is_limit ? Ending::stopped : Ending::unknown;
}

ExperimentResult termination_result(std::span<const TerminationCase> cases) {
  ExperimentResult result;
  result.definitions = definitions();
  result.tables = {stars_table(cases),
                   runs_table("solids", "Solids and files", those(cases, [](const auto& c) { return !is_star(c); })),
                   runs_table("star_runs", "Each run on a star", those(cases, is_star))};
  result.tables.back().is_data = true;
  result.findings = findings_of(cases);
  for (const TerminationCase& c : cases) {
    if (ending_of(c) != Ending::unknown) continue;
    result.problems.push_back(words_of(c) + ", " + std::string(name_of(c.protection)) + ": " +
                              std::string(name_of(c.status)) + ": " + c.reason);
    if (c.group != "file") result.is_good = false;
  }
  return result;
}

}  // namespace ccdt
