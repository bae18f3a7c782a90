#include "bench/experiments/mesher_quality.h"

#include <map>

#include "baselines/mesher.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

/// All that this build and this machine have of the meshers to compare, or what the user has asked for.
std::vector<QualityVariant> variants_of(const ExperimentOptions& options) {
  std::vector<QualityVariant> variants = {
      {"ccdt fcc", "ccdt", {"--lattice", "fcc", "--improve", "all"}, {}},
      {"ccdt fcc unimproved", "ccdt", {"--lattice", "fcc", "--improve", "none"}, {}},
      {"ccdt bcc", "ccdt", {"--lattice", "bcc", "--improve", "all"}, {}}};
  for (const char* name : {"tetgen", "cgal-mesh3", "gmsh-hxt"})
    if (is_measured(options, name)) variants.push_back({name, name, {"--improve", "all"}, {}});
  for (const std::string& file : described_meshers(options))
    variants.push_back({mesher(file).name, file, {"--improve", "all"}, {}});
  for (QualityVariant& variant : variants) variant.labels = {mesher(variant.mesher).name, variant.name};
  return variants;
}

ResultTable verdicts_table(const MesherQuality& quality) {
  ResultTable table{"verdicts",
                    "Better than all others?",
                    {{"model", "model", ColumnKind::label},
                     {"variant", "variant", ColumnKind::label},
                     {"criterion", "by", ColumnKind::label},
                     {"better", "better than all others"},
                     {"ours", "ours"},
                     {"best_other", "best of the others"},
                     {"best_other_variant", "whose"}}};
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows) {
      if (!row.is_ours) continue;
      for (const Verdict& v : judge(c, row)) {
        const bool is_alone = v.best_variant.empty();
        table.rows.push_back({{cell_of(c.name), cell_of(row.variant), cell_of(name_of(v.criterion)),
                               is_alone ? Cell() : cell_of(v.is_better()), v.ours, is_alone ? Cell() : Cell(v.best),
                               cell_of(v.best_variant)},
                              row.runs});
      }
    }
  return table;
}

/// In how many cases each variant of ours is better than all others, by each criterion.
std::vector<std::string> findings_of(const MesherQuality& quality) {
  struct Score {
    int better = 0, cases = 0;
  };
  std::map<std::string, std::map<Criterion, Score>> scores;
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows)
      for (const Verdict& verdict : row.is_ours ? judge(c, row) : std::vector<Verdict>()) {
        Score& score = scores[row.variant][verdict.criterion];
        score.better += verdict.is_better();
        score.cases += !verdict.best_variant.empty();
      }
  std::vector<std::string> lines;
  for (const auto& [variant, by_criterion] : scores) {
    std::string line = variant + " is better than all others";
    const char* separator = " in ";
    for (const auto& [criterion, score] : by_criterion) {
      line += separator + std::string(name_of(criterion)) + " in " + std::to_string(score.better) + " of " +
              std::to_string(score.cases);
      separator = ", ";
    }
    lines.push_back(line + " cases");
  }
  return lines;
}

}  // namespace

std::vector<Verdict> judge(const QualityCase& c, const QualityRow& ours) {
  std::vector<Verdict> verdicts;
  if (!ours.ok()) return verdicts;
  for (const Criterion criterion : judged_criteria) {
    Verdict verdict{criterion, value_of(ours.quality, criterion), 0, ""};
    for (const QualityRow& other : c.rows) {
      if (other.is_ours || !other.ok() || !other.is_comparable) continue;
      const double value = value_of(other.quality, criterion);
      if (!verdict.best_variant.empty() && !is_better(criterion, value, verdict.best)) continue;
      verdict.best = value;
      verdict.best_variant = other.variant;
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

std::vector<std::string> mesher_quality_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(
      definitions.end(),
      {
          "Every mesher gets the edge length at which it makes as many tetrahedra as our FCC mesh has.",
          "Rows that are more than 15% away from that number are shown, and not compared with.",
          "ccdt, tetgen and gmsh-hxt keep the surface; cgal-mesh3 makes its own within a tenth of the edge length.",
          "ccdt: --improve all, but where it says unimproved; tetgen: -pYq1.414/10a.",
          "cgal-mesh3: with perturbation and exudation.",
          "gmsh-hxt: Mesh.Algorithm3D=10 and Mesh.Optimize=1, seconds as its log has them.",
          "What takes long has at most three counted runs.",
      });
  return definitions;
}

MesherQuality measure_mesher_quality(const ExperimentOptions& options, const std::string& experiment,
                                     const std::vector<std::string>& models, const Progress& progress) {
  const StudyPlan plan{.experiment = experiment,
                       .models = models,
                       .labels = {{"mesher", "mesher", ColumnKind::label}, {"variant", "variant", ColumnKind::label}},
                       .variants = variants_of(options),
                       .equal_counts = true,
                       .once = false,
                       .keeps_meshes = true};
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const MesherQuality& quality) {
  ExperimentResult result = study_result(quality);
  result.definitions = mesher_quality_definitions();
  result.tables.insert(result.tables.begin() + 1, verdicts_table(quality));
  result.findings = findings_of(quality);
  return result;
}

}  // namespace ccdt
