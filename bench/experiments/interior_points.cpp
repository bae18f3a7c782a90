#include <algorithm>
#include <array>

#include "bench/experiments/existence_experiments.h"
#include "bench/experiments/surfaces.h"

namespace ccdt::experiments {
namespace {

constexpr std::array interior_points_lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};
constexpr double tetrahedra_per_trial = 100;  ///< small PLCs per family for each wanted tetrahedron
constexpr std::array interior_points_coarsenings = {4.0, 2.0, 1.0};  ///< of a solid's usual edge length

/// A rule that keeps interior points away from the surface.
struct InteriorRule {
  std::string name;
  std::vector<std::string> options;
};

const std::vector<InteriorRule>& rules() {
  static const std::vector<InteriorRule> all = {{"paper", {"--sphere-factor", "1"}},
                                                {"no spheres", {"--sphere-factor", "0"}},
                                                {"no distances", {"--sphere-factor", "0", "--clearance", "0.01"}}};
  return all;
}

std::vector<std::string> interior_points_definitions() {
  return {
      "The paper, section 3: \"Insertion of interior points does not affect CDT existence.\" It gives no proof.",
      "Family: small random PLCs with a CDT, to which one interior point is added; existence is tested by exhaustion.",
      "Existence rests on edge protection: each grazeable edge is a chain of Delaunay edges.",
      "For each protected edge, an empty sphere through its ends is chosen. It keeps the edge Delaunay.",
      "A point inside one of these spheres could destroy the edge, and is left out.",
      "Rule paper: no point in the smallest sphere of a face or subsegment, or near the surface.",
      "Near: within 0.55 edge lengths.",
      "Rule no spheres: the distance alone (--sphere-factor 0).",
      "Rule no distances: neither rule (--sphere-factor 0 --clearance 0.01).",
      "A case is one input at one density, with one lattice and one rule.",
      "The smallest known counterexample is a tetrahedron with a dent, five vertices, and one point below the dent.",
      "With that point, it has tetrahedralizations, but none is constrained Delaunay.",
  };
}

const char* const dropped_title = "points in the sphere of a protected edge";

ResultTable existence_table(std::span<const small_plcs::ExistenceTrials> existence) {
  ResultTable table = table_of("existence", "Existence with one more interior point, by exhaustive search",
                               {label_column("family"), figure_column("cases", "PLCs with a CDT"),
                                figure_column("lost", "of these, without a CDT once the point is added"),
                                note_column("counterexample", "the smallest; its last vertex is the point")});
  for (const small_plcs::ExistenceTrials& trials : existence)
    add_row(table, {}, trials.family, trials.cases, trials.lost,
            cell_if(trials.lost > 0, small_plcs::in_words(trials.counterexample)));
  return table;
}

ResultTable cases_table(std::span<const InteriorRow> rows) {
  const RowColumns<InteriorRow> columns = {
      {label_column("model"), &InteriorRow::model},
      {label_column("edge_length"),
       [](const InteriorRow& row) { return row.edge_length > 0 ? rounded(row.edge_length) : ""; }},
      {label_column("rule"), &InteriorRow::rule},
      {label_column("lattice"), [](const InteriorRow& row) { return name_of(row.lattice); }},
      status_column(),
      count_column("interior_vertices", &MeshCounts::interior_vertices),
      count_column("dropped", &MeshCounts::dropped_interior_vertices, dropped_title),
      reason_column()};
  return table_of_rows("cases", "The cases", columns, rows);
}

/// The sums over all successful cases of each rule, with one lattice and with all.
ResultTable rules_table(const ResultTable& cases) {
  ResultTable table = table_of(
      "rules", "Points that the rules allow",
      {label_column("rule"), label_column("lattice"), figure_column("cases"), figure_column("interior_vertices"),
       figure_column("dropped", dropped_title), figure_column("harmed", "cases with such points")});
  const auto add = [&](const std::string& rule, const std::string& lattice, const RowViews& rows) {
    const auto harmed = std::ranges::count_if(rows, [](const RowView& row) { return row.number("dropped") > 0; });
    add_row(table, {}, rule, lattice, std::uint64_t{rows.size()}, sum(rows, "interior_vertices"), sum(rows, "dropped"),
            static_cast<std::uint64_t>(harmed));
  };
  for (const InteriorRule& rule : rules()) {
    for (const Lattice lattice : interior_points_lattices) {
      const std::string name(name_of(lattice));
      add(rule.name, name, rows_with(cases, {{"rule", rule.name}, {"lattice", name}, {"status", "ok"}}));
    }
    add(rule.name, "all", rows_with(cases, {{"rule", rule.name}, {"status", "ok"}}));
  }
  return table;
}

/// The sentence about a rule from its row for all lattices.
std::string rule_finding(const RowView& row) {
  const std::string rule = "Rule \"" + row.text("rule") + "\": ";
  const std::uint64_t cases = row.count("cases"), placed = row.count("interior_vertices"),
                      dropped = row.count("dropped");
  if (cases == 0) return rule + "no case to judge by";
  if (dropped == 0)
    return rule + "no point threatened an edge in " + with_separators(cases) + " cases with " +
           with_separators(placed) + " interior vertices";
  return rule + "points threaten edges: " + with_separators(dropped) + " points of " +
         with_separators(placed + dropped) + " are in the sphere of a protected edge, in " +
         share_words(row.count("harmed"), cases) + " cases";
}

}  // namespace

ExperimentResult interior_points_result(std::span<const InteriorRow> rows,
                                        std::span<const small_plcs::ExistenceTrials> trials) {
  const ResultTable existence = existence_table(trials), cases = cases_table(rows), by_rule = rules_table(cases);
  const RowViews families = rows_with(existence);
  ExperimentResult result{.how = once(),
                          .definitions = interior_points_definitions(),
                          .tables = {existence, by_rule, cases},
                          .findings = {share_words(sum(families, "lost"), sum(families, "cases")) +
                                       " small PLCs with a CDT have none when one interior point is added"}};
  for (const RowView& row : rows_with(by_rule, {{"lattice", "all"}})) result.findings.push_back(rule_finding(row));
  for (const InteriorRow& row : rows) add_problem_of(row, result);
  return result;
}

ExperimentResult measure_interior_points(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<SurfaceFile> files = write_solids(options, "interior-points", interior_points_coarsenings);
  append(files, input_files(options));
  check_something_is_measured(files.size(), "interior-points");
  std::vector<InteriorRow> rows;
  for (const SurfaceFile& file : files)
    for (const Lattice lattice : interior_points_lattices)
      for (const InteriorRule& rule : rules()) {
        const std::string name(name_of(lattice)), at = file.edge_length > 0 ? " at " + rounded(file.edge_length) : "";
        std::vector<std::string> words = rule.options;
        append(words, std::vector<std::string>{"--improve", "none", "--steiner", "keep", "--lattice", name});
        InteriorRow& row = rows.emplace_back();
        row = {{}, file.name, file.edge_length, rule.name, lattice};
        row.measured.asked = single_case(options, joined({file.name + at, name, rule.name}), "ccdt", file.file, words);
      }
  measure_rows(runner, rows);
  return interior_points_result(
      rows, small_plcs::try_interior_points(static_cast<std::uint64_t>(options.tetrahedra / tetrahedra_per_trial)));
}

}  // namespace ccdt::experiments
