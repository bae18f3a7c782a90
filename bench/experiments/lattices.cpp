#include "bench/experiments/lattices.h"

#include <algorithm>
#include <nlohmann/json.hpp>

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
                     {"--lattice", std::string(name_of(lattice)), "--improve", improved ? "all" : "none"}});
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
  return {measure_study(options, {"lattices", {50000}, variants(), false, true}, progress)};
}

std::string to_json(const Lattices& lattices) {
  Json json = study_json("ccdt.lattices/1", lattices_definitions(), lattices);
  json["claims"] = Json::array();
  for (const LatticeClaim& claim : lattice_claims(lattices))
    json["claims"].push_back({{"criterion", name_of(claim.criterion)},
                              {"improved", claim.improved},
                              {"cases", claim.cases},
                              {"best", {{"fcc", claim.best[0]}, {"bcc", claim.best[1]}, {"sc", claim.best[2]}}},
                              {"fcc_is_best", claim.is_confirmed()}});
  return to_text(json);
}

}  // namespace ccdt
