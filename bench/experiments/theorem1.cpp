#include <algorithm>
#include <cmath>

#include "bench/experiments/existence_experiments.h"
#include "engine/io/plc_files.h"

namespace ccdt::experiments {
namespace {

constexpr double tetrahedra_per_case = 20;  ///< that a model is to get, for one PLC of each family
constexpr std::uint64_t seed = 20050901;

bool has_counterexample(const FamilyTrials& family) {
  return family.against_if + family.against_only_if > 0;
}

std::uint64_t sum(std::span<const FamilyTrials> families, bool cospherical, std::uint64_t FamilyTrials::*count) {
  std::uint64_t total = 0;
  for (const FamilyTrials& family : families)
    if (family.is_cospherical == cospherical) total += family.*count;
  return total;
}

std::string model_file(const FamilyTrials& family) {
  std::string name = family.name;
  std::ranges::replace(name, ' ', '-');
  return "models/theorem1-" + name + ".poly";
}

FamilyTrials measure(const Family& family, std::uint64_t cases, StepCounter& steps) {
  FamilyTrials trials{.name = std::string(family.name), .is_cospherical = family.is_cospherical};
  small_plcs::Random random(seed);
  for (std::uint64_t i = 0; i < cases; ++i) {
    steps.next(family.name);
    add_trial(small_plcs::try_plc(small_plcs::next_plc(family, random), family.is_cospherical), trials);
  }
  return trials;
}

std::vector<std::string> definitions() {
  std::vector<std::string> all = {
      "Theorem 1: \"If and only if a model X is grazeable edge protected and face protected, X has a DT.\"",
      "A DT is a constrained Delaunay tetrahedralization (CDT) whose tetrahedra are all Delaunay.",
      "Premise: a sphere through each grazeable edge, and through each facet triangle, has all other vertices outside.",
      "Of a facet with four corners the triangles are those that its Delaunay triangulation has.",
      "A PLC has a DT if the Delaunay tetrahedra in the domain fill it exactly and no facet or segment crosses them.",
      "Besides, all tetrahedralizations are searched for CDTs, and the two answers have to agree.",
      "All of this is exact and brute force, and shares nothing with the engine.",
      "In general position no five vertices are on a sphere, and no four in a plane but corners of a facet.",
      "The engine agrees if it adds no Steiner vertex and finds all faces Delaunay exactly where the premise holds,",
      "and if its mesh is the CDT wherever it adds no Steiner vertex.",
  };
  for (const Family& family : small_plcs::families())
    all.push_back(std::string(family.name) + ": " + std::string(family.what));
  return all;
}

ResultTable families_table(std::span<const FamilyTrials> families) {
  ResultTable table = table_of("families", "Small random PLCs held against Theorem 1",
                               {label_column("family"), label_column("position"), figure_column("cases", "PLCs"),
                                figure_column("premise", "edges and faces protected"), figure_column("dt", "with a DT"),
                                figure_column("against_if", "protected, without a DT"),
                                figure_column("against_only_if", "with a DT, not protected"),
                                figure_column("edges_alone", "faces protected, an edge not"),
                                figure_column("edges_alone_loose", "of these, the edge is of no facet"),
                                figure_column("edge_protected", "edges protected"),
                                figure_column("edge_protected_without_cdt", "of these, without a CDT"),
                                figure_column("engine_agrees", "the engine agrees"),
                                note_column("counterexample", "the smallest counterexample")});
  for (const FamilyTrials& f : families) {
    const std::string counterexample = model_file(f) + ": " + small_plcs::in_words(f.counterexample);
    add_row(table, {}, f.name, f.is_cospherical ? "one sphere" : "general", f.cases, f.premise, f.dt, f.against_if,
            f.against_only_if, f.edges_alone, f.edges_alone_loose, f.edge_protected, f.edge_protected_without_cdt,
            cell_if(!f.is_cospherical, f.cases - f.disagreements), cell_if(has_counterexample(f), counterexample));
  }
  return table;
}

/// "20 of 1,000", of the families in general position: those of `whole` without those of `exceptions`.
std::string general_share(std::span<const FamilyTrials> families, std::uint64_t FamilyTrials::*whole,
                          std::uint64_t FamilyTrials::*exceptions) {
  const std::uint64_t all = sum(families, false, whole);
  return share_words(all - sum(families, false, exceptions), all);
}

std::vector<std::string> findings_of(std::span<const FamilyTrials> families) {
  using F = FamilyTrials;
  const auto on_sphere = [&](auto part, auto whole) {
    return share_words(sum(families, true, part), sum(families, true, whole));
  };
  return {
      "If: " + general_share(families, &F::premise, &F::against_if) +
          " PLCs in general position that are grazeable edge protected and face protected have a DT",
      "Only if: " + general_share(families, &F::dt, &F::against_only_if) +
          " PLCs in general position that have a DT are grazeable edge protected and face protected",
      "The theorem's proviso: with all vertices on one sphere, " + on_sphere(&F::against_only_if, &F::dt) +
          " PLCs with a DT are not protected, and " + on_sphere(&F::against_if, &F::premise) +
          " that are protected have no DT",
      "Where all faces were protected but an edge was not, the edge was of no facet in " +
          share_words(sum(families, false, &F::edges_alone_loose), sum(families, false, &F::edges_alone)) + " PLCs",
      "Section 2: " + general_share(families, &F::edge_protected, &F::edge_protected_without_cdt) +
          " PLCs in general position that are grazeable edge protected have a CDT",
      "The engine and the exhaustive tests agree on " + general_share(families, &F::cases, &F::disagreements) +
          " PLCs in general position",
  };
}

}  // namespace

void add_trial(const small_plcs::Trial& trial, FamilyTrials& family) {
  const small_plcs::ProtectionState& protection = trial.protection;
  const bool premise = protection.premise();
  ++family.cases;
  family.premise += premise;
  family.dt += trial.has_dt;
  family.edges_alone += protection.faces && !protection.edges;
  family.edges_alone_loose += protection.faces && !protection.edges && protection.missing_is_loose;
  family.edge_protected += protection.edges;
  family.edge_protected_without_cdt += protection.edges && trial.search.constrained_delaunay == 0;
  if (!trial.disagreement.empty() && family.disagreements++ == 0)
    family.first_disagreement = trial.disagreement + ": " + small_plcs::in_words(trial.plc);
  if (premise == trial.has_dt) return;
  if (!has_counterexample(family) || trial.plc.vertices.size() < family.counterexample.vertices.size())
    family.counterexample = trial.plc;
  ++(premise ? family.against_if : family.against_only_if);
}

ExperimentResult theorem1_result(std::span<const FamilyTrials> families) {
  ExperimentResult result;
  result.definitions = definitions();
  result.tables = {families_table(families)};
  result.findings = findings_of(families);
  for (const FamilyTrials& family : families) {
    if (family.disagreements == 0) continue;
    add_problem(result, family.name + ": " + with_separators(family.disagreements) +
                            " PLCs; the first: " + family.first_disagreement);
  }
  return result;
}

ExperimentResult measure_theorem1(const ExperimentOptions& options, const Progress& progress) {
  Circumstances how = start_experiment(options, 1);
  const auto cases = static_cast<std::uint64_t>(std::max(1.0, std::round(options.tetrahedra / tetrahedra_per_case)));
  std::vector<FamilyTrials> families;
  StepCounter steps(progress, cases * small_plcs::families().size());
  for (const Family& family : small_plcs::families()) {
    families.push_back(measure(family, cases, steps));
    if (has_counterexample(families.back()))
      io::write_plc(small_plcs::as_input(families.back().counterexample), options.folder / model_file(families.back()));
  }
  ExperimentResult result = theorem1_result(families);
  result.how = std::move(how);
  return result;
}

}  // namespace ccdt::experiments
