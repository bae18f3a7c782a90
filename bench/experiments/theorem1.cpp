#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/experiments/existence_experiments.h"
#include "engine/io/plc_files.h"

namespace ccdt::experiments {
namespace {

constexpr double tetrahedra_per_case = 20;  ///< wanted tetrahedra per model, for one PLC of each family
constexpr std::uint64_t seed = 20050901;

/// A count of the trials of a family.
struct TrialCount {
  const char* name;
  const char* title;
  bool (*counts)(const small_plcs::Trial&);
};
using small_plcs::Trial;
constexpr std::array trial_counts = {
    TrialCount{"cases", "PLCs", [](const Trial&) { return true; }},
    TrialCount{"premise", "edges and faces protected", [](const Trial& t) { return t.protection.premise(); }},
    TrialCount{"dt", "with a DT", [](const Trial& t) { return t.has_dt; }},
    TrialCount{"against_if", "protected, without a DT",
               [](const Trial& t) { return t.protection.premise() && !t.has_dt; }},
    TrialCount{"against_only_if", "with a DT, not protected",
               [](const Trial& t) { return t.has_dt && !t.protection.premise(); }},
    TrialCount{"edges_alone", "faces protected, an edge not",
               [](const Trial& t) { return t.protection.faces && !t.protection.edges; }},
    TrialCount{
        "edges_alone_loose", "of these, the edge belongs to no facet",
        [](const Trial& t) { return t.protection.faces && !t.protection.edges && t.protection.missing_is_loose; }},
    TrialCount{"edge_protected", "edges protected", [](const Trial& t) { return t.protection.edges; }},
    TrialCount{"edge_protected_without_cdt", "of these, without a CDT",
               [](const Trial& t) { return t.protection.edges && t.search.constrained_delaunay == 0; }},
    TrialCount{"engine_agrees", "the engine agrees", [](const Trial& t) { return t.disagreement.empty(); }},
};

std::string model_file(const Family& family) {
  std::string name(family.name);
  std::ranges::replace(name, ' ', '-');
  return "models/theorem1-" + name + ".poly";
}

std::vector<std::string> theorem1_definitions() {
  std::vector<std::string> all = {
      "Theorem 1: \"If and only if a model X is grazeable edge protected and face protected, X has a DT.\"",
      "A DT is a constrained Delaunay tetrahedralization (CDT) whose tetrahedra are all Delaunay.",
      "Premise: a sphere through each grazeable edge, and through each facet triangle, has all other vertices outside.",
      "The triangles of a facet with four corners are those of its Delaunay triangulation.",
      "A PLC has a DT if the Delaunay tetrahedra in the domain fill it exactly and no facet or segment crosses them.",
      "In addition, all tetrahedralizations are searched for CDTs, and the two answers must agree.",
      "All of this is exact brute force, and shares no code with the engine.",
      "In general position, no five vertices are on a sphere, and no four are in a plane except corners of a facet.",
      "The engine agrees if it adds no Steiner vertex and finds all faces Delaunay exactly where the premise holds,",
      "and if its mesh is the CDT wherever it adds no Steiner vertex.",
  };
  for (const Family& family : small_plcs::families())
    all.push_back(std::string(family.name) + ": " + std::string(family.what));
  return all;
}

ResultTable families_table(std::span<const FamilyTrials> families) {
  ResultTable table = table_of("families", "Small random PLCs compared with Theorem 1",
                               {label_column("family"), label_column("position")});
  for (const TrialCount& count : trial_counts) table.columns.push_back(figure_column(count.name, count.title));
  table.columns.push_back(note_column("counterexample", "the smallest counterexample"));
  for (const FamilyTrials& trials : families) {
    const bool is_cospherical = trials.family.is_cospherical;
    std::vector<Cell> values = cells(trials.family.name, is_cospherical ? "one sphere" : "general");
    for (const std::uint64_t count : trials.counts) values.push_back(as_cell(count));
    if (is_cospherical) values.back() = {};  // the engine handles a different PLC
    values.push_back(cell_if(trials.has_counterexample(),
                             model_file(trials.family) + ": " + small_plcs::in_words(trials.counterexample)));
    table.rows.push_back({std::move(values)});
  }
  return table;
}

std::vector<std::string> findings_of(const ResultTable& table) {
  const RowViews general = rows_with(table, {{"position", "general"}}),
                 sphere = rows_with(table, {{"position", "one sphere"}});
  const auto share = [](const RowViews& families, const char* part, const char* whole) {
    return share_words(sum(families, part), sum(families, whole));
  };
  /// Counts for general position: those of `whole` without those of `exceptions`.
  const auto all_but = [&](const char* exceptions, const char* whole) {
    return share_words(sum(general, whole) - sum(general, exceptions), sum(general, whole));
  };
  return {
      "If: " + all_but("against_if", "premise") +
          " PLCs in general position that are grazeable edge protected and face protected have a DT",
      "Only if: " + all_but("against_only_if", "dt") +
          " PLCs in general position that have a DT are grazeable edge protected and face protected",
      "The theorem's proviso: with all vertices on one sphere, " + share(sphere, "against_only_if", "dt") +
          " PLCs with a DT are not protected, and " + share(sphere, "against_if", "premise") +
          " that are protected have no DT",
      "If all faces were protected but an edge was not, the edge belonged to no facet in " +
          share(general, "edges_alone_loose", "edges_alone") + " PLCs",
      "Section 2: " + all_but("edge_protected_without_cdt", "edge_protected") +
          " PLCs in general position that are grazeable edge protected have a CDT",
      "The engine and the exhaustive tests agree on " + share(general, "engine_agrees", "cases") +
          " PLCs in general position",
  };
}

}  // namespace

void add_trial(const Trial& trial, FamilyTrials& trials) {
  trials.counts.resize(trial_counts.size());
  for (std::size_t i = 0; i < trial_counts.size(); ++i) trials.counts[i] += trial_counts[i].counts(trial);
  if (!trial.disagreement.empty() && trials.disagreements++ == 0)
    trials.first_disagreement = trial.disagreement + ": " + small_plcs::in_words(trial.plc);
  if (trial.protection.premise() == trial.has_dt) return;
  if (!trials.has_counterexample() || trial.plc.vertices.size() < trials.counterexample.vertices.size())
    trials.counterexample = trial.plc;
}

ExperimentResult theorem1_result(std::span<const FamilyTrials> families) {
  ExperimentResult result{.how = once(), .definitions = theorem1_definitions(), .tables = {families_table(families)}};
  result.findings = findings_of(result.tables.front());
  for (const FamilyTrials& trials : families)
    if (trials.disagreements > 0)
      add_problem(result, std::string(trials.family.name) + ": " + with_separators(trials.disagreements) +
                              " PLCs; the first: " + trials.first_disagreement);
  return result;
}

ExperimentResult measure_theorem1(const ExperimentOptions& options, bench::Runner& runner) {
  const auto cases = static_cast<std::uint64_t>(std::max(1.0, std::round(options.tetrahedra / tetrahedra_per_case)));
  std::vector<FamilyTrials> families;
  for (const Family& family : small_plcs::families()) {
    FamilyTrials& trials = families.emplace_back(FamilyTrials{family});
    small_plcs::Random random(seed);
    for (std::uint64_t i = 0; i < cases; ++i) {
      report(runner.settings().progress, family.name, i + cases * (families.size() - 1),
             cases * small_plcs::families().size());
      add_trial(small_plcs::try_plc(small_plcs::next_plc(family, random), family.is_cospherical), trials);
    }
    if (trials.has_counterexample())
      io::write_plc(small_plcs::as_input(trials.counterexample), options.folder / model_file(family));
  }
  return theorem1_result(families);
}

}  // namespace ccdt::experiments
