#include "bench/experiments/lattice_fit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "baselines/common.h"

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
  std::vector<QualityVariant> variants;
  for (const LatticeSetting& setting : lattice_settings())
    variants.push_back({name_of(setting),
                        "ccdt",
                        {"--lattice", "fcc", "--improve", "all", "--sphere-factor", digits(setting.sphere_factor),
                         "--clearance", digits(setting.clearance)}});
  return {measure_study(options, {"lattice-fit", {50000}, variants, false, true}, progress)};
}

std::string to_json(const LatticeFit& fit) {
  Json json = study_json("ccdt.lattice-fit/1", lattice_fit_definitions(), fit);
  json["default"] = name_of(default_lattice_setting());
  json["summary"] = Json::array();
  for (const SettingSummary& s : summarize(fit))
    json["summary"].push_back({{"sphere_factor", s.setting.sphere_factor},
                               {"clearance", s.setting.clearance},
                               {"rank", s.rank},
                               {"mean_r", s.mean_r},
                               {"p99_r", s.p99_r},
                               {"worst_r", s.worst_r},
                               {"smallest_dihedral", s.smallest_dihedral},
                               {"largest_worst_r", s.largest_worst_r},
                               {"least_dihedral", s.least_dihedral},
                               {"improve_seconds", s.improve_seconds}});
  return to_text(json);
}

}  // namespace ccdt
