#include "bench/experiments/quality_experiments.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "baselines/mesher.h"
#include "engine/base/digits.h"

namespace ccdt::experiments {
namespace {

constexpr std::array all_lattices = {Lattice::fcc, Lattice::bcc, Lattice::sc};
constexpr std::array sphere_factors = {0.9, 1.0, 1.1, 1.2};
constexpr std::array clearances = {0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8};

/// All that this build and this machine have of the meshers to compare, or what the user has asked for.
std::vector<QualityVariant> mesher_variants(const ExperimentOptions& options) {
  std::vector<QualityVariant> variants = {
      {"ccdt fcc", "ccdt", {"--lattice", "fcc", "--improve", "all"}, {}},
      {"ccdt fcc unimproved", "ccdt", {"--lattice", "fcc", "--improve", "none"}, {}},
      {"ccdt bcc", "ccdt", {"--lattice", "bcc", "--improve", "all"}, {}}};
  for (const char* name : {"tetgen", "cgal-mesh3", "gmsh-hxt"})
    if (is_measured(options, name)) variants.push_back({name, name, {"--improve", "all"}, {}});
  for (const std::string& file : described_meshers(options))
    variants.push_back({baselines::mesher(file).name, file, {"--improve", "all"}, {}});
  for (QualityVariant& variant : variants) variant.labels = {baselines::mesher(variant.mesher).name, variant.name};
  return variants;
}

ResultTable verdicts_table(const MesherQuality& quality) {
  ResultTable table =
      table_of("verdicts", "Better than all others?",
               {label_column("model"), label_column("variant"), label_column("criterion", "by"),
                figure_column("better", "better than all others"), figure_column("ours"),
                figure_column("best_other", "best of the others"), figure_column("best_other_variant", "whose")});
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows) {
      if (!row.is_ours) continue;
      for (const QualityComparison& v : compare_with_others(c, row)) {
        const bool is_alone = v.best_variant.empty();
        add_row(table, row.runs, c.name, row.variant, name_of(v.criterion), cell_if(!is_alone, v.is_better()), v.ours,
                cell_if(!is_alone, v.best), v.best_variant);
      }
    }
  return table;
}

/// In how many cases each variant of ours is better than all others, by each criterion.
std::vector<std::string> verdict_findings(const MesherQuality& quality) {
  struct Score {
    std::uint64_t better = 0, cases = 0;
  };
  std::map<std::string, std::map<Criterion, Score>> scores;
  for (const QualityCase& c : quality.cases)
    for (const QualityRow& row : c.rows)
      for (const QualityComparison& verdict :
           row.is_ours ? compare_with_others(c, row) : std::vector<QualityComparison>()) {
        Score& score = scores[row.variant][verdict.criterion];
        score.better += verdict.is_better();
        score.cases += !verdict.best_variant.empty();
      }
  std::vector<std::string> lines;
  for (const auto& [variant, by_criterion] : scores) {
    std::vector<std::string> parts;
    for (const auto& [criterion, score] : by_criterion)
      parts.push_back(std::string(name_of(criterion)) + " in " + share_words(score.better, score.cases));
    lines.push_back(variant + " is better than all others in " + joined(parts) + " cases");
  }
  return lines;
}

std::string variant_name(Lattice lattice, bool improved) {
  return std::string(name_of(lattice)) + (improved ? " improved" : "");
}

std::vector<QualityVariant> lattice_variants() {
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
void add_case(const QualityCase& c, LatticeClaim& claim) {
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
ResultTable best_lattice_table(const std::vector<LatticeClaim>& claims) {
  ResultTable table =
      table_of("best", "The best lattice",
               {label_column("criterion", "by"), label_column("improved"),
                figure_column("confirmed", "FCC alone is the best in every case"), figure_column("cases"),
                figure_column("fcc", "FCC best"), figure_column("bcc", "BCC best"), figure_column("sc", "SC best")});
  for (const LatticeClaim& claim : claims)
    add_row(table, {}, name_of(claim.criterion), claim.improved, claim.is_confirmed(), claim.cases, claim.best[0],
            claim.best[1], claim.best[2]);
  return table;
}

std::vector<std::string> lattice_findings(const std::vector<LatticeClaim>& claims) {
  std::vector<std::string> lines;
  for (const bool improved : {false, true}) {
    std::vector<std::string> confirmed, refuted;
    for (const LatticeClaim& claim : claims) {
      if (claim.improved != improved || claim.cases == 0) continue;
      (claim.is_confirmed() ? confirmed : refuted).emplace_back(name_of(claim.criterion));
    }
    const std::string meshes = improved ? "after improvement by: " : "before improvement by: ";
    if (!confirmed.empty()) lines.push_back("That FCC is best is confirmed " + meshes + joined(confirmed));
    if (!refuted.empty()) lines.push_back("That FCC is best is not confirmed " + meshes + joined(refuted));
  }
  return lines;
}

/// Is no other row of the case better?
bool is_best(const QualityCase& c, const QualityRow& row, Criterion criterion) {
  const double ours = value_of(row.quality, criterion);
  return row.ok() && std::ranges::none_of(c.rows, [&](const QualityRow& other) {
           return other.ok() && is_better(criterion, value_of(other.quality, criterion), ours);
         });
}

/// In how many cases each part is the best, alone or with others.
ResultTable best_part_table(const ImprovementParts& parts) {
  ResultTable table = table_of("best", "The best in so many cases",
                               {label_column("improve", "improvement"), label_column("criterion", "by"),
                                figure_column("cases"), figure_column("best", "best in")});
  if (parts.cases.empty()) return table;
  for (std::size_t i = 0; i < parts.cases.front().rows.size(); ++i)
    for (const Criterion criterion : judged_criteria) {
      std::uint64_t best = 0;
      for (const QualityCase& c : parts.cases) best += i < c.rows.size() && is_best(c, c.rows[i], criterion);
      add_row(table, {}, parts.cases.front().rows[i].variant, name_of(criterion), parts.cases.size(), best);
    }
  return table;
}

/// The cases that can be summed up: every setting went well.
std::vector<const QualityCase*> whole_cases(const LatticeFit& fit, std::size_t settings) {
  std::vector<const QualityCase*> cases;
  for (const QualityCase& c : fit.cases)
    if (c.rows.size() == settings && std::ranges::all_of(c.rows, &QualityRow::ok)) cases.push_back(&c);
  return cases;
}

/// From 1: by how many rows this one is surpassed; those that are as good share the mean of their places.
double rank_of(const QualityRow& row, const QualityCase& c, Criterion criterion) {
  const double value = value_of(row.quality, criterion);
  double better = 0, equal = 0;
  for (const QualityRow& other : c.rows) {
    const double theirs = value_of(other.quality, criterion);
    better += is_better(criterion, theirs, value);
    equal += theirs == value;
  }
  return better + (equal + 1) / 2;
}

SettingSummary summary_of(const LatticeSetting& setting, std::size_t number,
                          const std::vector<const QualityCase*>& cases) {
  SettingSummary sum{setting};
  sum.least_dihedral = 180;
  const double share = 1 / static_cast<double>(cases.size());
  for (const QualityCase* c : cases) {
    const QualityRow& row = c->rows[number];
    const bench::Quality& q = row.quality;
    sum.mean_r += share * q.r.mean;
    sum.p99_r += share * q.r.p99;
    sum.worst_r += share * std::log(q.r.max);
    sum.smallest_dihedral += share * q.dihedral_degrees.min;
    sum.largest_worst_r = std::max(sum.largest_worst_r, q.r.max);
    sum.least_dihedral = std::min(sum.least_dihedral, q.dihedral_degrees.min);
    sum.improve_seconds += row.improve_seconds;
    for (const Criterion criterion : judged_criteria)
      sum.rank += share * rank_of(row, *c, criterion) / static_cast<double>(judged_criteria.size());
  }
  sum.worst_r = std::exp(sum.worst_r);
  return sum;
}

ResultTable settings_table(const std::vector<SettingSummary>& summaries) {
  ResultTable table =
      table_of("settings", "The settings",
               {label_column("setting"), figure_column("rank"), figure_column("mean_r"),
                figure_column("p99_r", "99% of r below"), figure_column("worst_r"),
                figure_column("largest_worst_r", "worst r of all"), figure_column("smallest_dihedral", "", "degrees"),
                figure_column("least_dihedral", "smallest of all", "degrees"),
                time_column("improve_seconds", "improvement", "s")});
  for (const SettingSummary& s : summaries)
    add_row(table, {}, text_of(s.setting), s.rank, s.mean_r, s.p99_r, s.worst_r, s.largest_worst_r, s.smallest_dihedral,
            s.least_dihedral, s.improve_seconds);
  return table;
}

std::vector<std::string> setting_findings(const std::vector<SettingSummary>& summaries) {
  if (summaries.empty()) return {"There is no surface on which every setting went well."};
  const auto usual = std::ranges::find(summaries, default_lattice_setting(), &SettingSummary::setting);
  auto best = std::ranges::min_element(summaries, {}, &SettingSummary::rank);
  if (usual->rank <= best->rank) best = usual;  // as good as any
  std::vector<std::string> lines = {"The best setting is " + text_of(best->setting) + ", with a mean rank of " +
                                    rounded(best->rank) + " among " + std::to_string(summaries.size())};
  if (best->setting == usual->setting)
    lines.emplace_back("It is the default");
  else
    lines.push_back("The default, " + text_of(usual->setting) + ", has a mean rank of " + rounded(usual->rank));
  return lines;
}

}  // namespace

double value_of(const bench::Quality& quality, Criterion criterion) {
  switch (criterion) {
    case Criterion::mean_r:
      return quality.r.mean;
    case Criterion::p99_r:
      return quality.r.p99;
    case Criterion::worst_r:
      return quality.r.max;
    case Criterion::smallest_dihedral:
      return quality.dihedral_degrees.min;
    case Criterion::largest_dihedral:
      return quality.dihedral_degrees.max;
  }
  return 0;
}

bool is_better(Criterion criterion, double a, double b) {
  return criterion == Criterion::smallest_dihedral ? a > b : a < b;
}

std::vector<QualityComparison> compare_with_others(const QualityCase& c, const QualityRow& ours) {
  std::vector<QualityComparison> comparisons;
  if (!ours.ok()) return comparisons;
  for (const Criterion criterion : judged_criteria) {
    QualityComparison comparison{criterion, value_of(ours.quality, criterion), 0, ""};
    for (const QualityRow& other : c.rows) {
      if (other.is_ours || !other.ok() || !other.is_comparable) continue;
      const double value = value_of(other.quality, criterion);
      if (!comparison.best_variant.empty() && !is_better(criterion, value, comparison.best)) continue;
      comparison.best = value;
      comparison.best_variant = other.variant;
    }
    comparisons.push_back(comparison);
  }
  return comparisons;
}

MesherQuality measure_mesher_quality(const ExperimentOptions& options, const std::string& experiment,
                                     const std::vector<std::string>& models, const Progress& progress) {
  const StudyPlan plan{.experiment = experiment,
                       .models = models,
                       .labels = {label_column("mesher"), label_column("variant")},
                       .variants = mesher_variants(options),
                       .equal_counts = true,
                       .once = false,
                       .keeps_meshes = true};
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const MesherQuality& quality) {
  const std::vector<std::string> definitions = {
      "Every mesher gets the edge length at which it makes as many tetrahedra as our FCC mesh has.",
      "Rows that are more than 15% away from that number are shown, and not compared with.",
      "ccdt, tetgen and gmsh-hxt keep the surface; cgal-mesh3 makes its own within a tenth of the edge length.",
      "ccdt: --improve all, but where it says unimproved; tetgen: -pYq1.414/10a.",
      "cgal-mesh3: with perturbation and exudation.",
      "gmsh-hxt: Mesh.Algorithm3D=10 and Mesh.Optimize=1, seconds as its log has them.",
      "What takes long has at most three counted runs.",
  };
  ExperimentResult result = study_result(quality, definitions);
  result.tables.insert(result.tables.begin() + 1, verdicts_table(quality));
  result.findings = verdict_findings(quality);
  return result;
}

std::vector<LatticeClaim> lattice_claims(const Lattices& lattices) {
  std::vector<LatticeClaim> claims;
  for (const bool improved : {false, true})
    for (const Criterion criterion : lattice_criteria) {
      LatticeClaim claim{criterion, improved};
      for (const QualityCase& c : lattices.cases) add_case(c, claim);
      claims.push_back(claim);
    }
  return claims;
}

Lattices measure_lattices(const ExperimentOptions& options, const Progress& progress) {
  const StudyPlan plan{.experiment = "lattices",
                       .models = names_of_paper_models(),
                       .labels = {label_column("lattice"), label_column("improved")},
                       .variants = lattice_variants(),
                       .equal_counts = false,
                       .once = true};
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const Lattices& lattices) {
  const std::vector<std::string> definitions = {
      "The paper, section 3: of a unit cell, the tetrahedra of the FCC lattice are better than others.",
      "All lattices have the same number of vertices per volume, and the same surface.",
      "The claim is confirmed by a measure if FCC alone is the best in every case.",
      "Improvement stops at a target: lattices that all reach it differ in worst values by chance.",
  };
  ExperimentResult result = study_result(lattices, definitions);
  const std::vector<LatticeClaim> claims = lattice_claims(lattices);
  result.tables.insert(result.tables.begin(), best_lattice_table(claims));
  result.findings = lattice_findings(claims);
  return result;
}

ImprovementParts measure_improvement(const ExperimentOptions& options, const Progress& progress) {
  StudyPlan plan{.experiment = "improvement",
                 .models = names_of_paper_models(),
                 .labels = {label_column("improve", "improvement")},
                 .variants = {}};
  for (const char* improve : {"none", "swap", "smooth", "all"})
    plan.variants.push_back({improve, "ccdt", {"--lattice", "fcc", "--improve", improve}, {improve}});
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const ImprovementParts& parts) {
  const std::vector<std::string> definitions = {
      "none: the constrained Delaunay tetrahedralization with its FCC lattice.",
      "swap: other tetrahedra of the same vertices. smooth: other places for them.",
      "all: both, and vertices inside are inserted and taken out.",
      "Improve: median seconds of the improvement, which are part of the seconds.",
  };
  ExperimentResult result = study_result(parts, definitions);
  result.tables.insert(result.tables.begin(), best_part_table(parts));
  return result;
}

LatticeSetting default_lattice_setting() {
  return {MeshOptions().sphere_factor, MeshOptions().clearance};
}

std::vector<LatticeSetting> lattice_settings() {
  std::vector<LatticeSetting> settings;
  for (const double sphere_factor : sphere_factors)
    for (const double clearance : clearances) settings.push_back({sphere_factor, clearance});
  if (std::ranges::find(settings, default_lattice_setting()) == settings.end())
    settings.push_back(default_lattice_setting());
  return settings;
}

std::string text_of(const LatticeSetting& setting) {
  return "sphere " + digits(setting.sphere_factor) + ", clearance " + digits(setting.clearance);
}

std::vector<SettingSummary> summarize(const LatticeFit& fit) {
  const std::vector<LatticeSetting> settings = lattice_settings();
  const auto cases = whole_cases(fit, settings.size());
  std::vector<SettingSummary> summaries;
  if (cases.empty()) return summaries;
  for (std::size_t i = 0; i < settings.size(); ++i) summaries.push_back(summary_of(settings[i], i, cases));
  return summaries;
}

LatticeFit measure_lattice_fit(const ExperimentOptions& options, const Progress& progress) {
  StudyPlan plan{.experiment = "lattice-fit",
                 .models = names_of_paper_models(),
                 .labels = {label_column("setting")},
                 .variants = {},
                 .equal_counts = false,
                 .once = true};
  for (const LatticeSetting& setting : lattice_settings())
    plan.variants.push_back({text_of(setting),
                             "ccdt",
                             {"--lattice", "fcc", "--improve", "all", "--sphere-factor", digits(setting.sphere_factor),
                              "--clearance", digits(setting.clearance)},
                             {text_of(setting)}});
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const LatticeFit& fit) {
  const std::vector<std::string> definitions = {
      "Sphere: no lattice point in the smallest sphere of a face, its radius times --sphere-factor.",
      "Clearance: none nearer to the surface than --clearance edge lengths.",
      "Rank: of the setting among all, from 1, mean over the cases and the four criteria.",
      "The criteria: mean, p99 and worst r, and the smallest dihedral angle. The best has the least rank.",
      "Improvement stops at a target: settings that all reach it differ in worst values by chance.",
      "Columns are means over the cases; of worst r the geometric one. Improve: their seconds together.",
  };
  ExperimentResult result = study_result(fit, definitions);
  const std::vector<SettingSummary> summaries = summarize(fit);
  result.tables.insert(result.tables.begin(), settings_table(summaries));
  result.findings = setting_findings(summaries);
  return result;
}

}  // namespace ccdt::experiments
