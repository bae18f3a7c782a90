#include "bench/experiments/quality_experiments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "baselines/mesher.h"
#include "bench/experiments/unit_cells.h"
#include "engine/base/digits.h"

namespace ccdt::experiments {
namespace {

/// The criteria for comparing meshes: columns of the table of quality.
constexpr std::array<std::string_view, 5> all_criteria = {"mean_r", "p99_r", "worst_r", "smallest_dihedral",
                                                          "largest_dihedral"};
constexpr std::span<const std::string_view> judged_criteria = std::span(all_criteria).first<4>();

std::string in_words(std::string_view criterion) {
  std::string words(criterion);
  std::ranges::replace(words, '_', ' ');
  return words;
}

/// Is a strictly better than b?
bool is_better(std::string_view criterion, double a, double b) {
  return criterion == "smallest_dihedral" ? a > b : a < b;
}

bool is_ok(const RowView& mesh) {
  return mesh.text("status") == "ok";
}

/// The rows of a table of meshes, by model.
std::vector<RowViews> meshes_by_model(const ResultTable& table) {
  std::vector<RowViews> models;
  for (const RowView& mesh : rows_with(table)) {
    if (models.empty() || models.back().front().text("model") != mesh.text("model")) models.emplace_back();
    models.back().push_back(mesh);
  }
  return models;
}

/// The rows of the table of quality, by model.
std::vector<RowViews> meshes_by_model(const ExperimentResult& result) {
  return meshes_by_model(*results::find_table(result, "quality"));
}

/// Keeps the models whose meshes were all made successfully and have tetrahedra.
std::vector<RowViews> whole(std::vector<RowViews> models) {
  std::erase_if(models, [](const RowViews& meshes) {
    return !std::ranges::all_of(meshes, [](const RowView& m) { return is_ok(m) && m.number("tetrahedra") > 0; });
  });
  return models;
}

/// The number of models on which no other mesh is better than the one with this number.
std::uint64_t best_in(const std::vector<RowViews>& models, std::size_t number, std::string_view criterion) {
  const auto is_best = [&](const RowViews& meshes) {
    const RowView& mesh = meshes[number];
    return is_ok(mesh) && std::ranges::none_of(meshes, [&](const RowView& other) {
             return is_ok(other) && is_better(criterion, other.number(criterion), mesh.number(criterion));
           });
  };
  return static_cast<std::uint64_t>(std::ranges::count_if(models, is_best));
}

/// The best comparable mesh of other meshers by a criterion; none if there is no such mesh.
std::optional<RowView> best_other(const RowViews& meshes, std::string_view criterion) {
  std::optional<RowView> best;
  for (const RowView& mesh : meshes) {
    if (mesh.text("mesher") == "ccdt" || !is_ok(mesh) || mesh.text("comparable") != "yes") continue;
    if (!best || is_better(criterion, mesh.number(criterion), best->number(criterion))) best = mesh;
  }
  return best;
}

ResultTable verdicts_table(const ExperimentResult& result) {
  ResultTable table = table_of("verdicts", "Better than all others?",
                               {label_column("model"), label_column("variant"), label_column("criterion", "by"),
                                figure_column("better", "better than all others"), figure_column("ours"),
                                figure_column("best_other", "best of the others"),
                                figure_column("best_other_variant", "mesher of the best of the others")});
  for (const RowViews& meshes : meshes_by_model(result))
    for (const RowView& mesh : meshes) {
      if (mesh.text("mesher") != "ccdt" || !is_ok(mesh)) continue;
      for (const std::string_view criterion : judged_criteria) {
        const double ours = mesh.number(criterion);
        const auto best = best_other(meshes, criterion);
        const double theirs = best ? best->number(criterion) : 0;
        add_row(table, mesh.row->runs, mesh.text("model"), mesh.text("variant"), in_words(criterion),
                cell_if(best.has_value(), is_better(criterion, ours, theirs)), ours, cell_if(best.has_value(), theirs),
                best ? best->text("variant") : "");
      }
    }
  return table;
}

/// The number of cases in which each variant of ours is better than all others, by each criterion.
void conclude_mesher_quality(ExperimentResult& result) {
  const ResultTable verdicts = verdicts_table(result);
  std::set<std::string> variants;
  for (const RowView& row : rows_with(verdicts)) variants.insert(row.text("variant"));
  for (const std::string& variant : variants) {
    std::vector<std::string> shares;
    for (const std::string_view criterion : judged_criteria) {
      const auto count = [&](const std::string& better) {
        return rows_with(verdicts, {{"variant", variant}, {"criterion", in_words(criterion)}, {"better", better}})
            .size();
      };
      shares.push_back(in_words(criterion) + " in " + share_words(count("yes"), count("yes") + count("no")));
    }
    result.findings.push_back(variant + " is better than all others in " + joined(shares) + " cases");
  }
  result.tables.insert(result.tables.begin() + 1, verdicts);
}

/// The tables of meshes of different lattices, and what they are in words.
constexpr std::array<std::pair<const char*, const char*>, 3> lattice_meshes = {
    {{"inside", "away from the surface"}, {"whole", "in whole meshes, unimproved"}, {"improved", "after improvement"}}};

/// The meshes that have these texts in a table, in the columns of a table of meshes by lattice.
ResultTable lattice_table(const ResultTable& from, const std::map<std::string, std::string>& texts, std::string name,
                          std::string title) {
  ResultTable table = table_of(std::move(name), std::move(title), {});
  constexpr std::array<std::string_view, 9> kept = {"model",           "lattice", "status",  "tetrahedra",
                                                    "mean_r",          "p99_r",   "worst_r", "smallest_dihedral",
                                                    "largest_dihedral"};
  for (const std::string_view column : kept) table.columns.push_back(from.columns[column_of(from, column)]);
  for (const RowView& mesh : rows_with(from, texts)) {
    ResultRow& row = table.rows.emplace_back();
    for (const std::string_view column : kept) row.cells.push_back(cell(from, *mesh.row, column));
    row.runs = mesh.row->runs;
  }
  return table;
}

/// The number of cases in which each lattice is the best by each criterion, alone or with others.
ResultTable best_lattices_table(const ExperimentResult& result) {
  ResultTable table =
      table_of("best", "The best lattice in meshes",
               {label_column("criterion", "by"), label_column("meshes"),
                figure_column("confirmed", "FCC alone is the best in every case"), figure_column("cases"),
                figure_column("fcc", "FCC best"), figure_column("bcc", "BCC best"), figure_column("sc", "SC best")});
  for (const auto& [name, words] : lattice_meshes)
    for (const std::string_view criterion : all_criteria) {
      const auto models = whole(meshes_by_model(*results::find_table(result, name)));
      const auto best = [&](std::size_t lattice) { return best_in(models, lattice, criterion); };
      const bool is_confirmed = !models.empty() && best(0) == models.size() && best(1) == 0 && best(2) == 0;
      add_row(table, {}, in_words(criterion), name, is_confirmed, std::uint64_t{models.size()}, best(0), best(1),
              best(2));
    }
  return table;
}

/// By which criteria is FCC the best in meshes, and by which is it not?
std::vector<std::string> mesh_findings(const ResultTable& best) {
  std::vector<std::string> findings;
  for (const auto& [name, words] : lattice_meshes)
    for (const std::string confirmed : {"yes", "no"}) {
      std::vector<std::string> criteria;
      for (const RowView& row : rows_with(best, {{"meshes", name}, {"confirmed", confirmed}}))
        if (row.count("cases") > 0) criteria.push_back(row.text("criterion"));
      if (criteria.empty()) continue;
      findings.push_back("That FCC is best is " + std::string(confirmed == "yes" ? "" : "not ") + "confirmed " + words +
                         " by: " + joined(criteria));
    }
  return findings;
}

/// The unit cells come first, because the claim is about them; then the meshes: inside, whole, improved.
void conclude_lattices(ExperimentResult& result) {
  ResultTable& quality = *std::ranges::find(result.tables, "quality", &ResultTable::name);
  ResultTable& inside = *std::ranges::find(result.tables, "inside", &ResultTable::name);
  inside = lattice_table(inside, {}, inside.name, inside.title);
  std::vector<ResultTable> tables = {
      unit_cells_table(), inside, lattice_table(quality, {{"improved", "no"}}, "whole", "Whole meshes, unimproved"),
      lattice_table(quality, {{"improved", "yes"}}, "improved", "Whole meshes, improved")};
  tables.insert(tables.begin() + 1, unit_cell_criteria_table(tables.front()));
  quality.is_data = true;  // for charts; its figures are in the tables of whole meshes
  std::erase_if(result.tables, [](const ResultTable& table) { return table.name == "inside"; });
  result.tables.insert(result.tables.begin(), tables.begin(), tables.end());
  const ResultTable best = best_lattices_table(result);
  result.findings = unit_cell_findings(result.tables[1]);
  append(result.findings, mesh_findings(best));
  result.tables.insert(result.tables.begin() + 2, best);
}

/// The number of cases in which each part is the best, alone or with others.
void conclude_improvement(ExperimentResult& result) {
  ResultTable table = table_of("best", "Number of cases in which each is the best",
                               {label_column("improve", "improvement"), label_column("criterion", "by"),
                                figure_column("cases"), figure_column("best", "best in")});
  const auto models = meshes_by_model(result);
  for (std::size_t part = 0; !models.empty() && part < models.front().size(); ++part)
    for (const std::string_view criterion : judged_criteria)
      add_row(table, {}, models.front()[part].text("improve"), in_words(criterion), std::uint64_t{models.size()},
              best_in(models, part, criterion));
  result.tables.insert(result.tables.begin(), table);
}

std::string setting_in_words(double sphere_factor, double clearance) {
  return "sphere " + digits(sphere_factor) + ", clearance " + digits(clearance);
}

std::string default_setting() {
  return setting_in_words(MeshOptions().sphere_factor, MeshOptions().clearance);
}

/// The rank of a mesh, from 1; equally good meshes share the mean of their ranks.
double rank_of(const RowView& mesh, const RowViews& others, std::string_view criterion) {
  const double value = mesh.number(criterion);
  double better = 0, equal = 0;
  for (const RowView& other : others) {
    better += is_better(criterion, other.number(criterion), value);
    equal += other.number(criterion) == value;
  }
  return better + (equal + 1) / 2;
}

/// A setting over all models.
void add_setting(const std::vector<RowViews>& models, std::size_t setting, ResultTable& table) {
  double rank = 0, mean_r = 0, p99_r = 0, log_worst_r = 0, largest_worst_r = 0, smallest_dihedral = 0,
         least_dihedral = 180, improve_seconds = 0;
  const double share = 1 / static_cast<double>(models.size());
  for (const RowViews& meshes : models) {
    const RowView& mesh = meshes[setting];
    const double worst_r = mesh.number("worst_r"), dihedral = mesh.number("smallest_dihedral");
    mean_r += share * mesh.number("mean_r");
    p99_r += share * mesh.number("p99_r");
    log_worst_r += share * std::log(worst_r);
    largest_worst_r = std::max(largest_worst_r, worst_r);
    smallest_dihedral += share * dihedral;
    least_dihedral = std::min(least_dihedral, dihedral);
    improve_seconds += mesh.number("improve_seconds");
    for (const std::string_view criterion : judged_criteria)
      rank += share * rank_of(mesh, meshes, criterion) / static_cast<double>(judged_criteria.size());
  }
  add_row(table, {}, models.front()[setting].text("setting"), rank, mean_r, p99_r, std::exp(log_worst_r),
          largest_worst_r, smallest_dihedral, least_dihedral, improve_seconds);
}

std::vector<std::string> setting_findings(const ResultTable& table) {
  const RowViews settings = rows_with(table);
  if (settings.empty()) return {"There is no surface on which every setting succeeded."};
  const auto rank = [](const RowView& row) { return row.number("rank"); };
  const RowView usual = rows_with(table, {{"setting", default_setting()}}).front();
  RowView best = *std::ranges::min_element(settings, {}, rank);
  if (rank(usual) <= rank(best)) best = usual;  // equally good
  return {"The best setting is " + best.text("setting") + ", with a mean rank of " + rounded(rank(best)) + " among " +
              std::to_string(settings.size()),
          best.row == usual.row ? "It is the default"
                                : "The default, " + default_setting() + ", has a mean rank of " + rounded(rank(usual))};
}

/// Sums up the models on which every setting succeeded.
void conclude_lattice_fit(ExperimentResult& result) {
  ResultTable table =
      table_of("settings", "The settings",
               {label_column("setting"), figure_column("rank"), figure_column("mean_r"),
                figure_column("p99_r", "99% of r below"), figure_column("worst_r"),
                figure_column("largest_worst_r", "worst r of all"), figure_column("smallest_dihedral", "", "degrees"),
                figure_column("least_dihedral", "smallest of all", "degrees"),
                time_column("improve_seconds", "improvement", "s")});
  const auto models = whole(meshes_by_model(result));
  for (std::size_t setting = 0; !models.empty() && setting < models.front().size(); ++setting)
    add_setting(models, setting, table);
  result.findings = setting_findings(table);
  result.tables.insert(result.tables.begin(), table);
}

}  // namespace

namespace {

std::vector<std::string> with_refinement(const std::string& improve) {
  return {"--lattice", "refinement", "--radius-edge", "1.414", "--improve", improve};
}

}  // namespace

StudyPlan mesher_quality_plan(const ExperimentOptions& options, const std::string& experiment,
                              const std::vector<std::string>& models) {
  StudyPlan plan{.experiment = experiment,
                 .models = models,
                 .labels = {label_column("mesher"), label_column("variant")},
                 .variants = {{"paper fcc", "ccdt", {"--lattice", "fcc", "--improve", "swap-smooth"}},
                              {"refinement", "ccdt", with_refinement("swap-smooth")},
                              {"refinement unimproved", "ccdt", with_refinement("none")},
                              {"ccdt fcc", "ccdt", {"--lattice", "fcc", "--improve", "all"}},
                              {"ccdt fcc unimproved", "ccdt", {"--lattice", "fcc", "--improve", "none"}},
                              {"ccdt bcc", "ccdt", {"--lattice", "bcc", "--improve", "all"}}},
                 .conclude = conclude_mesher_quality,
                 .equal_counts = true,
                 .keeps_meshes = true};
  plan.definitions = {
      "The models are ours: the paper gives neither the geometry nor the sizes of its three parts.",
      "Every mesher gets the edge length at which it makes as many tetrahedra as the paper's mesh, found by search.",
      "Rows that differ by more than 3% from that number are shown but not compared.",
      "paper fcc: the paper's lattice, swaps and smoothing (--improve swap-smooth). The claim is about this row.",
      "refinement: Delaunay refinement of our own on the same surface, with the same swaps and smoothing.",
      "So it differs in one thing, where the interior vertices are. Its bound of radius over edge is TetGen's, 1.414.",
      "ccdt, tetgen and gmsh-hxt keep the surface; cgal-mesh3 makes its own within a tenth of the edge length.",
      "ccdt fcc and bcc: --improve all, unless marked unimproved; tetgen: -pYq1.414/10a.",
      "cgal-mesh3: with perturbation and exudation.",
      "gmsh-hxt: Mesh.Algorithm3D=10 and Mesh.Optimize=1; its seconds come from its log.",
  };
  std::vector<std::string> others = described_meshers(options);
  for (const char* name : {"gmsh-hxt", "cgal-mesh3", "tetgen"})
    if (is_measured(options, name)) others.insert(others.begin(), name);
  for (const std::string& other : others)
    plan.variants.push_back({baselines::mesher(other).name, other, {"--improve", "all"}});
  for (QualityVariant& variant : plan.variants) variant.labels = {baselines::mesher(variant.mesher).name, variant.name};
  return plan;
}

StudyPlan lattices_plan() {
  StudyPlan plan{.experiment = "lattices",
                 .models = names_of_paper_models(),
                 .labels = {label_column("lattice"), label_column("improved")},
                 .definitions = unit_cell_definitions(),
                 .conclude = conclude_lattices,
                 .once = true};
  append(plan.definitions,
         std::vector<std::string>{
             "Meshes: all lattices have the same number of vertices per volume and the same surface.",
             "Inside: no vertex is on the surface, or joined by an edge to one that is; unimproved.",
             "Thin models have none at small scales.",
             "In meshes, FCC is confirmed as the best by a measure if it alone is in every case.",
             "Improvement stops at a target: lattices that reach it differ in worst values by chance."});
  for (const bool improved : {false, true})
    for (const std::string name : {"fcc", "bcc", "sc"})
      plan.variants.push_back({.name = name + (improved ? " improved" : ""),
                               .mesher = "ccdt",
                               .words = {"--lattice", name, "--improve", improved ? "all" : "none"},
                               .labels = {name, improved ? "yes" : "no"},
                               .measures_inside = !improved});
  return plan;
}

StudyPlan improvement_plan() {
  StudyPlan plan{
      .experiment = "improvement",
      .models = names_of_paper_models(),
      .labels = {label_column("improve", "improvement")},
      .definitions = {"none: the constrained Delaunay tetrahedralization with its FCC lattice.",
                      "swap: other tetrahedra of the same vertices. smooth: other positions of the vertices.",
                      "swap-smooth: both, as in the paper. all: also, interior vertices are inserted and removed.",
                      "Improve: median seconds of improvement, included in the seconds."},
      .conclude = conclude_improvement};
  for (const char* improve : {"none", "swap", "smooth", "swap-smooth", "all"})
    plan.variants.push_back({improve, "ccdt", {"--lattice", "fcc", "--improve", improve}, {improve}});
  return plan;
}

StudyPlan lattice_fit_plan() {
  StudyPlan plan{.experiment = "lattice-fit",
                 .models = names_of_paper_models(),
                 .labels = {label_column("setting")},
                 .conclude = conclude_lattice_fit,
                 .once = true};
  plan.definitions = {
      "Sphere: no lattice point is in the smallest sphere of a face, with its radius times --sphere-factor.",
      "Clearance: no lattice point is nearer to the surface than --clearance edge lengths.",
      "Rank: that of the setting among all, from 1; mean over the cases and the four criteria.",
      "The criteria: mean, p99 and worst r, and the smallest dihedral angle. The best has the least rank.",
      "Improvement stops at a target: settings that all reach it differ in worst values by chance.",
      "Columns are means over the cases; for worst r, geometric means. Improve: the sum of their seconds.",
  };
  const auto add = [&](double sphere_factor, double clearance) {
    const std::string name = setting_in_words(sphere_factor, clearance);
    if (std::ranges::find(plan.variants, name, &QualityVariant::name) != plan.variants.end()) return;
    plan.variants.push_back({name,
                             "ccdt",
                             {"--lattice", "fcc", "--improve", "all", "--sphere-factor", digits(sphere_factor),
                              "--clearance", digits(clearance)},
                             {name}});
  };
  for (const double sphere_factor : {0.9, 1.0, 1.1, 1.2})
    for (const double clearance : {0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8}) add(sphere_factor, clearance);
  add(MeshOptions().sphere_factor, MeshOptions().clearance);
  return plan;
}

}  // namespace ccdt::experiments
