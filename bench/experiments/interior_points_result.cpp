#include <array>

#include "bench/experiments/interior_points.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

constexpr std::array rules = {InteriorRule::paper, InteriorRule::no_spheres, InteriorRule::no_distances};

std::string words_of(const InteriorCase& c) {
  return c.input + (c.edge_length > 0 ? " at " + rounded(c.edge_length) : "");
}

ResultTable rules_table(const InteriorPoints& points) {
  ResultTable table{"rules",
                    "What the rules let through",
                    {{"rule", "rule", ColumnKind::label},
                     {"lattice", "lattice", ColumnKind::label},
                     {"cases", "cases"},
                     {"interior_vertices", "interior vertices"},
                     {"dropped", "points that would have destroyed a protected edge"},
                     {"harmed", "cases with such points"}}};
  const auto add = [&](InteriorRule rule, std::string_view lattice, const InteriorSummary& s) {
    table.rows.push_back({{cell_of(name_of(rule)), cell_of(lattice), cell_of(s.cases), cell_of(s.placed),
                           cell_of(s.dropped), cell_of(s.harmed)},
                          {}});
  };
  for (const InteriorRule rule : rules) {
    for (const Lattice lattice : {Lattice::fcc, Lattice::bcc, Lattice::sc})
      add(rule, name_of(lattice), summarize(points.cases, rule, lattice));
    add(rule, "all", summarize(points.cases, rule));
  }
  return table;
}

ResultTable cases_table(const InteriorPoints& points) {
  ResultTable table{"cases",
                    "The cases",
                    {{"model", "model", ColumnKind::label},
                     {"edge_length", "edge length", ColumnKind::label},
                     {"rule", "rule", ColumnKind::label},
                     {"lattice", "lattice", ColumnKind::label},
                     {"status", "status", ColumnKind::label},
                     {"interior_vertices", "interior vertices"},
                     {"dropped", "points that would have destroyed a protected edge"},
                     {"reason", "reason", ColumnKind::note}}};
  for (const InteriorCase& c : points.cases)
    table.rows.push_back({{cell_of(c.input), cell_of(c.edge_length > 0 ? rounded(c.edge_length) : ""),
                           cell_of(name_of(c.rule)), cell_of(name_of(c.lattice)), cell_of(name_of(c.status)),
                           cell_of(c.placed), cell_of(c.dropped), cell_of(c.reason)},
                          c.runs});
  return table;
}

ResultTable existence_table(const InteriorPoints& points) {
  ResultTable table{"existence",
                    "Existence with one interior point more, by exhaustion",
                    {{"family", "family", ColumnKind::label},
                     {"cases", "PLCs with a CDT"},
                     {"lost", "of these without one with the point"},
                     {"counterexample", "the smallest, its last vertex the point", ColumnKind::note}}};
  for (const ExistenceTrials& trials : points.existence)
    table.rows.push_back({{cell_of(trials.family), cell_of(trials.cases), cell_of(trials.lost),
                           trials.lost > 0 ? Cell(small::in_words(trials.counterexample)) : Cell()},
                          {}});
  return table;
}

std::string existence_finding(const InteriorPoints& points) {
  std::uint64_t cases = 0, lost = 0;
  for (const ExistenceTrials& trials : points.existence) {
    cases += trials.cases;
    lost += trials.lost;
  }
  return with_separators(lost) + " of " + with_separators(cases) +
         " small PLCs with a CDT have none when one interior point is added";
}

std::vector<std::string> findings_of(const InteriorPoints& points) {
  std::vector<std::string> lines = {existence_finding(points)};
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

}  // namespace

ExperimentResult result_of(const InteriorPoints& points) {
  ExperimentResult result{.how = points.how,
                          .definitions = interior_points_definitions(),
                          .tables = {existence_table(points), rules_table(points), cases_table(points)},
                          .findings = findings_of(points)};
  for (const InteriorCase& c : points.cases) {
    if (c.status == RunStatus::ok) continue;
    result.problems.push_back(words_of(c) + ", " + std::string(name_of(c.lattice)) + ", " +
                              std::string(name_of(c.rule)) + ": " + std::string(name_of(c.status)) + ": " + c.reason);
    result.is_good = false;
  }
  return result;
}

}  // namespace ccdt
