#include "bench/experiments/mesher_quality.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "baselines/mesher.h"

namespace ccdt {
namespace {

constexpr std::string_view our_prefix = "ccdt ";

/// All that this build and this machine have of the meshers to compare, or what the user has asked for.
std::vector<QualityVariant> variants_of(const ExperimentOptions& options) {
  std::vector<QualityVariant> variants = {{"ccdt fcc", "ccdt", {"--lattice", "fcc", "--improve", "all"}},
                                          {"ccdt bcc", "ccdt", {"--lattice", "bcc", "--improve", "all"}}};
  for (const char* name : {"tetgen", "cgal-mesh3", "gmsh-hxt"}) {
    const bool is_there = std::ranges::find(meshers(), name, &Mesher::name) != meshers().end();
    const bool is_wanted = !options.beside || std::ranges::find(*options.beside, name) != options.beside->end();
    if (is_there && is_wanted) variants.push_back({name, name, {"--improve", "all"}});
  }
  return variants;
}

Json verdicts_json(const QualityCase& c) {
  Json all = Json::array();
  for (const QualityRow& row : c.rows)
    for (const Verdict& verdict : is_ours(row) ? judge(c, row) : std::vector<Verdict>())
      all.push_back({{"variant", row.variant},
                     {"criterion", name_of(verdict.criterion)},
                     {"ours", verdict.ours},
                     {"best_other", verdict.best_variant.empty() ? Json(nullptr) : Json(verdict.best)},
                     {"best_other_variant", verdict.best_variant},
                     {"better_than_all", verdict.is_better()}});
  return all;
}

}  // namespace

bool is_ours(const QualityRow& row) {
  return row.variant.starts_with(our_prefix);
}

std::vector<Verdict> judge(const QualityCase& c, const QualityRow& ours) {
  std::vector<Verdict> verdicts;
  if (!ours.ok()) return verdicts;
  for (const Criterion criterion : judged_criteria) {
    Verdict verdict{criterion, value_of(ours.quality, criterion), 0, ""};
    for (const QualityRow& other : c.rows) {
      if (is_ours(other) || !other.ok() || !other.is_comparable) continue;
      const double value = value_of(other.quality, criterion);
      if (!verdict.best_variant.empty() && !is_better(criterion, value, verdict.best)) continue;
      verdict.best = value;
      verdict.best_variant = other.variant;
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

bool forbids_dihedral(const SurfaceAngles& angles, double degrees) {
  return angles.dihedral.degrees < degrees;
}

std::vector<std::string> mesher_quality_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(
      definitions.end(),
      {
          "Every mesher gets the edge length at which it makes as many tetrahedra as our FCC mesh has.",
          "Rows that are more than 15% away from that number are shown, and not compared with.",
          "ccdt, tetgen and gmsh-hxt keep the surface; cgal-mesh3 makes its own within a tenth of the edge length.",
          "ccdt: --improve all; tetgen: -pYq1.414/10a; cgal-mesh3: with perturbation and exudation.",
          "gmsh-hxt: Mesh.Algorithm3D=10 and Mesh.Optimize=1, seconds as its log has them.",
          "An angle between two facets forbids larger dihedral angles: a tetrahedron has to fit into it.",
          "A small angle of a triangle forbids none, but is the reason for bad tetrahedra next to it.",
          "A size at which a run takes more than 10 s has at most three counted runs.",
      });
  return definitions;
}

MesherQuality measure_mesher_quality(const ExperimentOptions& options, const Progress& progress) {
  const StudyPlan plan{"quality", {50000, 500000}, variants_of(options), true, false};
  return {measure_study(options, plan, progress)};
}

std::string to_json(const MesherQuality& quality) {
  Json json = study_json("ccdt.quality/1", mesher_quality_definitions(), quality);
  for (std::size_t i = 0; i < quality.cases.size(); ++i) json["cases"][i]["verdicts"] = verdicts_json(quality.cases[i]);
  return to_text(json);
}

}  // namespace ccdt
