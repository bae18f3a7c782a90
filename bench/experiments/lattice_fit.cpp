#include "bench/experiments/lattice_fit.h"

#include <algorithm>
#include <cmath>

#include "bench/results/numbers.h"
#include "bench/results/result_table.h"
#include "engine/base/digits.h"

namespace ccdt {
namespace {

constexpr std::array sphere_factors = {0.9, 1.0, 1.1, 1.2};
constexpr std::array clearances = {0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8};

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
    const Quality& q = row.quality;
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

}  // namespace

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

std::string name_of(const LatticeSetting& setting) {
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

namespace {

ResultTable settings_table(const LatticeFit& fit) {
  ResultTable table{"settings",
                    "The settings",
                    {{"setting", "setting", ColumnKind::label},
                     {"rank", "rank"},
                     {"mean_r", "mean r"},
                     {"p99_r", "99% of r below"},
                     {"worst_r", "worst r"},
                     {"largest_worst_r", "worst r of all"},
                     {"smallest_dihedral", "smallest dihedral", ColumnKind::figure, "degrees"},
                     {"least_dihedral", "smallest of all", ColumnKind::figure, "degrees"},
                     {"improve_seconds", "improvement", ColumnKind::time, "s"}}};
  for (const SettingSummary& s : summarize(fit))
    table.rows.push_back({{cell_of(name_of(s.setting)), s.rank, s.mean_r, s.p99_r, s.worst_r, s.largest_worst_r,
                           s.smallest_dihedral, s.least_dihedral, s.improve_seconds},
                          {}});
  return table;
}

std::vector<std::string> findings_of(const LatticeFit& fit) {
  const std::vector<SettingSummary> summaries = summarize(fit);
  if (summaries.empty()) return {"There is no surface on which every setting went well."};
  const auto usual = std::ranges::find(summaries, default_lattice_setting(), &SettingSummary::setting);
  auto best = std::ranges::min_element(summaries, {}, &SettingSummary::rank);
  if (usual->rank <= best->rank) best = usual;  // as good as any
  std::vector<std::string> lines = {"The best setting is " + name_of(best->setting) + ", with a mean rank of " +
                                    rounded(best->rank) + " among " + std::to_string(summaries.size())};
  if (best->setting == usual->setting)
    lines.emplace_back("It is the default");
  else
    lines.push_back("The default, " + name_of(usual->setting) + ", has a mean rank of " + rounded(usual->rank));
  return lines;
}

}  // namespace

std::vector<std::string> lattice_fit_definitions() {
  std::vector<std::string> definitions = study_definitions();
  definitions.insert(
      definitions.end(),
      {
          "Sphere: no lattice point in the smallest sphere of a face, its radius times --sphere-factor.",
          "Clearance: none nearer to the surface than --clearance edge lengths.",
          "Rank: of the setting among all, from 1, mean over the cases and the four criteria.",
          "The criteria: mean, p99 and worst r, and the smallest dihedral angle. The best has the least rank.",
          "Improvement stops at a target: settings that all reach it differ in worst values by chance.",
          "Columns are means over the cases; of worst r the geometric one. Improve: their seconds together.",
      });
  return definitions;
}

LatticeFit measure_lattice_fit(const ExperimentOptions& options, const Progress& progress) {
  StudyPlan plan{.experiment = "lattice-fit",
                 .models = names_of_paper_models(),
                 .labels = {{"setting", "setting", ColumnKind::label}},
                 .variants = {},
                 .equal_counts = false,
                 .once = true};
  for (const LatticeSetting& setting : lattice_settings())
    plan.variants.push_back({name_of(setting),
                             "ccdt",
                             {"--lattice", "fcc", "--improve", "all", "--sphere-factor", digits(setting.sphere_factor),
                              "--clearance", digits(setting.clearance)},
                             {name_of(setting)}});
  return {measure_study(options, plan, progress)};
}

ExperimentResult result_of(const LatticeFit& fit) {
  ExperimentResult result = study_result(fit);
  result.definitions = lattice_fit_definitions();
  result.tables.insert(result.tables.begin(), settings_table(fit));
  result.findings = findings_of(fit);
  return result;
}

}  // namespace ccdt
