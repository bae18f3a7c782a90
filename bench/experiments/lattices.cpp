#include "bench/experiments/lattices.h"

#include <algorithm>

#include "bench/results/result_table.h"
#include "bench/run_record.h"

namespace ccdt {
namespace {

constexpr std::array all_lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};

std::string variant_name(Lattice lattice, bool improved) {
  return std::string(name_of(lattice)) + (improved ? " improved" : "");
}

std::vector<QualityVariant> variants() {
  std::vector<QualityVariant> all;
  for (const bool improved : {false, true})
    for (const Lattice lattice : all_lattices)
      all.push_back({variant_name(lattice, improved),
                     "ccdt",
                     {"--lattice", std::string(name_of(lattice)), "--improve", improved ? "all" : "none"},
                     {std::string(name_of(lattice)), improved ? "yes" : "no"}});
  return all;
}

/// Adds a case to a claim, if all three lattices went well in it.
void take(const QualityCase& c, LatticeClaim& claim) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = std::ranges::find(c.rows, variant_name(all_lattices[i], claim.improved), &QualityRow::variant);
    if (row == c.rows.end() || !row->ok()) return;
    values[i] = value_of(row->quality, claim.criterion);
  }
  ++claim.cases;
  for (std::size_t i = 0; i < values.size(); ++i)
    claim.best[i] += std::ranges::none_of(values, [&](double v) { return is_better(claim.criterion, v, values[i]); });
}

/// In how many cases each lattice is the best.
ResultTable best_table(const Lattices& lattices) {
  ResultTable table{"best",
                    "The best lattice",
                    {{"criterion", "by", ColumnKind::label},
                     {"improved", "improved", ColumnKind::label},
                     {"confirmed", "FCC alone is the best in every case"},
                     {"cases", "cases"},
                     {"fcc", "FCC best"},
                     {"bcc", "BCC best"},
                     {"sc", "SC best"}}};
  for (const LatticeClaim& claim : lattice_claims(lattices))
    table.rows.push_back(
        {{cell_of(name_of(claim.criterion)), cell_of(claim.improved), cell_of(claim.is_confirmed()),
          cell_of(claim.cases), cell_of(claim.best[0]), cell_of(claim.best[1]), cell_of(claim.best[2])},
         {}});
  return table;
}

std::vector<std::string> findings_of(const Lattices& lattices) {
  std::vector<std::string> lines;
  for (const bool improved : {false, true}) {
    std::string confirmed, refuted;
    for (const LatticeClaim& claim : lattice_claims(lattices)) {
      if (claim.improved != improved || claim.cases == 0) continue;
      std::string& list = claim.is_confirmed() ? confirmed : refuted;
      list += (list.empty() ? "" : ", ") + std::string(name_of(claim.criterion));
    }
    const std::string meshes = improved ? "after improvement by: " : "before improvement by: ";
    if (!confirmed.empty()) lines.push_back(("That FCC is best is confirmed " + meshes).append(confirmed));
    if (!refuted.empty()) lines.push_back(("That FCC is best is not confirmed " + meshes).append(refuted));
  }
  return lines;
}

}  // namespace

std::vector<LatticeClaim> lattice_claims(const Lattices& lattices) {
  std::vector<LatticeClaim> claims;
  for (const bool improved : {false, true})
    for (const Criterion criterion : lattice_criteria) {
      LatticeClaim claim{criterion, improved};
      for (const QualityCase& c : lattices.cases) take(c, claim);
      claims.push_back(claim);
    }
  return claims;
}

std::vector<std::string> lattices_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(
      definitions.end(),
      {
          "The paper, section 3: of a unit cell, the tetrahedra of the FCC lattice are better than others.",
          "All lattices have the same number of vertices per volume, and the same surface.",
          "The claim is confirmed by a measure if FCC alone is the best in every case.",
          "Improvement stops at a target: lattices that all reach it differ in worst values by chance.",
      });
  return definitions;
}

Lattices measure_lattices(const ExperimentOptions& options, const Progress& progress) {
  const StudyPlan plan{
      .experiment = "lattices",
      .models = names_of_paper_models(),
      .labels = {{"lattice", "lattice", ColumnKind::label}, {"improved", "improved", ColumnKind::label}},
      .variants = variants(),
      .equal_counts = false,
      .once = true};
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const Lattices& lattices) {
  ExperimentResult result = study_result(lattices);
  result.definitions = lattices_definitions();
  result.tables.insert(result.tables.begin(), best_table(lattices));
  result.findings = findings_of(lattices);
  return result;
}

}  // namespace ccdt
