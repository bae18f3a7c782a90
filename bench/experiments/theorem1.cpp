#include "bench/experiments/theorem1.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/experiments/small_plcs/families.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"
#include "engine/io/plc_files.h"

namespace ccdt {
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

FamilyTrials measure(const small::Family& family, std::uint64_t cases, const std::function<void()>& announce) {
  FamilyTrials trials{.name = std::string(family.name), .is_cospherical = family.is_cospherical};
  small::Random random(seed);
  for (std::uint64_t i = 0; i < cases; ++i) {
    announce();
    add_trial(small::try_plc(small::next_plc(family, random), family.is_cospherical), trials);
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
  for (const small::Family& family : small::families())
    all.push_back(std::string(family.name) + ": " + std::string(family.what));
  return all;
}

ResultRow row_of(const FamilyTrials& f) {
  const Cell agreements = f.is_cospherical ? Cell{} : cell_of(f.cases - f.disagreements);
  const Cell note = has_counterexample(f) ? Cell(model_file(f) + ": " + small::in_words(f.counterexample)) : Cell{};
  return {{f.name, f.is_cospherical ? "one sphere" : "general", cell_of(f.cases), cell_of(f.premise), cell_of(f.dt),
           cell_of(f.against_if), cell_of(f.against_only_if), cell_of(f.edges_alone), cell_of(f.edges_alone_loose),
           cell_of(f.edge_protected), cell_of(f.edge_protected_without_cdt), agreements, note}};
}

ResultTable table_of(std::span<const FamilyTrials> families) {
  ResultTable table{"families",
                    "Small random PLCs held against Theorem 1",
                    {{"family", "family", ColumnKind::label},
                     {"position", "position", ColumnKind::label},
                     {"cases", "PLCs"},
                     {"premise", "edges and faces protected"},
                     {"dt", "with a DT"},
                     {"against_if", "protected, without a DT"},
                     {"against_only_if", "with a DT, not protected"},
                     {"edges_alone", "faces protected, an edge not"},
                     {"edges_alone_loose", "of these, the edge is of no facet"},
                     {"edge_protected", "edges protected"},
                     {"edge_protected_without_cdt", "of these, without a CDT"},
                     {"engine_agrees", "the engine agrees"},
                     {"counterexample", "the smallest counterexample", ColumnKind::note}}};
  for (const FamilyTrials& family : families) table.rows.push_back(row_of(family));
  return table;
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  return with_separators(part) + " of " + with_separators(whole);
}

std::vector<std::string> findings_of(std::span<const FamilyTrials> families) {
  const auto general = [&](auto count) { return sum(families, false, count); };
  const auto on_sphere = [&](auto count) { return sum(families, true, count); };
  return {
      "If: " +
          share(general(&FamilyTrials::premise) - general(&FamilyTrials::against_if), general(&FamilyTrials::premise)) +
          " PLCs in general position that are grazeable edge protected and face protected have a DT",
      "Only if: " +
          share(general(&FamilyTrials::dt) - general(&FamilyTrials::against_only_if), general(&FamilyTrials::dt)) +
          " PLCs in general position that have a DT are grazeable edge protected and face protected",
      "The theorem's proviso: with all vertices on one sphere, " +
          share(on_sphere(&FamilyTrials::against_only_if), on_sphere(&FamilyTrials::dt)) +
          " PLCs with a DT are not protected, and " +
          share(on_sphere(&FamilyTrials::against_if), on_sphere(&FamilyTrials::premise)) +
          " that are protected have no DT",
      "Where all faces were protected but an edge was not, the edge was of no facet in " +
          share(general(&FamilyTrials::edges_alone_loose), general(&FamilyTrials::edges_alone)) + " PLCs",
      "Section 2: " +
          share(general(&FamilyTrials::edge_protected) - general(&FamilyTrials::edge_protected_without_cdt),
                general(&FamilyTrials::edge_protected)) +
          " PLCs in general position that are grazeable edge protected have a CDT",
      "The engine and the exhaustive tests agree on " +
          share(general(&FamilyTrials::cases) - general(&FamilyTrials::disagreements), general(&FamilyTrials::cases)) +
          " PLCs in general position",
  };
}

}  // namespace

void add_trial(const small::Trial& trial, FamilyTrials& family) {
  const small::ProtectionState& protection = trial.protection;
  const bool premise = protection.premise();
  ++family.cases;
  family.premise += premise;
  family.dt += trial.has_dt;
  family.edges_alone += protection.faces && !protection.edges;
  family.edges_alone_loose += protection.faces && !protection.edges && protection.missing_is_loose;
  family.edge_protected += protection.edges;
  family.edge_protected_without_cdt += protection.edges && trial.search.constrained_delaunay == 0;
  if (!trial.disagreement.empty() && family.disagreements++ == 0)
    family.first_disagreement = trial.disagreement + ": " + small::in_words(trial.plc);
  if (premise == trial.has_dt) return;
  if (!has_counterexample(family) || trial.plc.vertices.size() < family.counterexample.vertices.size())
    family.counterexample = trial.plc;
  ++(premise ? family.against_if : family.against_only_if);
}

ExperimentResult theorem1_result(std::span<const FamilyTrials> families) {
  ExperimentResult result;
  result.definitions = definitions();
  result.tables = {table_of(families)};
  result.findings = findings_of(families);
  for (const FamilyTrials& family : families) {
    if (family.disagreements == 0) continue;
    result.problems.push_back(family.name + ": " + with_separators(family.disagreements) +
                              " PLCs; the first: " + family.first_disagreement);
    result.is_good = false;
  }
  return result;
}

ExperimentResult measure_theorem1(const ExperimentOptions& options, const Progress& progress) {
  Circumstances how = start_experiment(options);
  how.runs = 1;
  const auto cases = static_cast<std::uint64_t>(std::max(1.0, std::round(options.tetrahedra / tetrahedra_per_case)));
  std::vector<FamilyTrials> families;
  std::uint64_t done = 0;
  for (const small::Family& family : small::families()) {
    families.push_back(
        measure(family, cases, [&] { report(progress, family.name, done++, cases * small::families().size()); }));
    if (has_counterexample(families.back()))
      write_plc(small::as_input(families.back().counterexample), options.folder / model_file(families.back()));
  }
  ExperimentResult result = theorem1_result(families);
  result.how = std::move(how);
  return result;
}

}  // namespace ccdt
