#include "bench/experiments/quality_study.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "baselines/mesher_input.h"
#include "bench/experiments/count_search.h"
#include "bench/experiments/inside_cells.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/io/plc_files.h"
#include "engine/plc/build_plc.h"
#include "engine/surface/remesh_surface.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

constexpr const char* mesh_format = ".vtu";  ///< of meshes that are kept

/// The models of the plan and the user's files. Models come without a file: they are made for each edge length.
std::vector<SurfaceFile> sources_of(const ExperimentOptions& options, const StudyPlan& plan) {
  std::vector<SurfaceFile> sources;
  for (const std::string& model : plan.models)
    if (is_chosen(options, model)) sources.push_back({model, {}});
  append(sources, input_files(options));
  return sources;
}

/// One source while it is measured.
struct SourceStudy {
  const ExperimentOptions& options;
  bench::Runner& runner;
  const StudyPlan& plan;
  const SurfaceFile& source;
  std::string title;  ///< "piston, 10,000 tetrahedra"

  bench::Case case_of(const QualityVariant& variant, const std::filesystem::path& surface, double edge_length) const {
    std::vector<std::string> words = variant.words;
    append(words, std::vector<std::string>{"--edge-length", digits(edge_length), "--grading", "0"});
    return single_case(options, title + ", " + variant.name, variant.mesher, surface, words);
  }
};

std::optional<std::uint64_t> count_of(const bench::MeasuredCase& measured) {
  if (measured.failed()) return {};
  return measured.first.counts.tetrahedra;
}

/// Remeshes a surface, unless its triangles are even and have about this edge length, and writes it.
/// \throw InputError, MeshError  as `remesh_surface`
EvenSurface make_even_surface(plc::InputPlc input, double edge_length, const std::filesystem::path& file) {
  const bool is_even = bench::has_even_triangles(plc::build_plc(input), edge_length);
  if (!is_even) input = surface::remesh_surface(input, {.edge_length = edge_length});
  io::write_plc(input, file);
  const plc::Plc plc = plc::build_plc(input);
  return {{}, file, edge_length, !is_even, plc.vertices.size(), plc.triangles.size(), bench::smallest_angles(plc)};
}

/// Searches for the edge length at which our FCC lattice makes the wanted number of tetrahedra. Surface and inside have
/// the same edge length.
EvenSurface find_surface(const SourceStudy& study) {
  const auto& [name, user_file, ignored] = study.source;
  const auto solid = std::ranges::find(models::solids(), name, &models::Solid::name);
  const bool is_solid = user_file.empty();
  const plc::InputPlc input = is_solid ? models::make_solid(name, solid->default_edge_length) : io::read_plc(user_file);
  const double volume = bench::enclosed_volume(plc::build_plc(input)), wanted = study.options.tetrahedra;
  bench::CountSearch search{.wanted = wanted,
                            .first = std::cbrt(volume / wanted / baselines::regular_tetrahedron_volume(1)),
                            .most_tries = 5};
  if (is_solid) search.shortest = solid->finest;
  if (is_solid) search.longest = solid->coarsest;
  std::vector<EvenSurface> tried;
  std::string reason;
  const auto found = bench::search_edge_length(search, [&](double edge_length) {
    const std::string file = study.plan.experiment + "-" + name + "-" + digits(edge_length) + ".poly";
    tried.push_back(make_even_surface(is_solid ? models::make_solid(name, edge_length) : input, edge_length,
                                      study.options.folder / "models" / file));
    const bench::MeasuredCase measured = study.runner.run(
        study.case_of({"surface", "ccdt", {"--lattice", "fcc", "--improve", "none"}}, tried.back().file, edge_length));
    reason = measured.first.reason;
    return count_of(measured);
  });
  if (!found) throw MeshError("no surface of this source was meshed: " + reason, {}, "");
  EvenSurface best = *std::ranges::find(tried, found->edge_length, &EvenSurface::edge_length);
  best.model = name;
  return best;
}

/// The target edge lengths of the variants.
std::vector<double> edge_lengths_of(const SourceStudy& study, const EvenSurface& surface) {
  std::vector<double> lengths(study.plan.variants.size(), surface.edge_length);
  if (!study.plan.equal_counts) return lengths;
  const auto try_length = [&](const QualityVariant& variant, double edge_length) {
    return count_of(study.runner.run(study.case_of(variant, surface.file, edge_length)));
  };
  const auto wanted = try_length(study.plan.variants.front(), surface.edge_length);
  if (!wanted) return lengths;
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    const auto found = bench::search_edge_length(
        {.wanted = static_cast<double>(*wanted), .first = surface.edge_length, .tolerance = 0.02, .most_tries = 12},
        [&](double edge_length) { return try_length(study.plan.variants[i], edge_length); });
    if (found) lengths[i] = found->edge_length;
  }
  return lengths;
}

/// Runs every variant once. Short ones are repeated until their times have an interval.
std::vector<bench::MeasuredCase> run_variants(const SourceStudy& study, const EvenSurface& surface,
                                              const std::vector<double>& edge_lengths) {
  std::vector<bench::Case> all;
  for (std::size_t i = 0; i < edge_lengths.size(); ++i)
    all.push_back(study.case_of(study.plan.variants[i], surface.file, edge_lengths[i]));
  for (std::size_t i = 0; i < all.size(); ++i)
    if (study.plan.variants[i].measures_inside) all[i].mesh_ending = mesh_format;
  std::vector<bench::MeasuredCase> measured = study.runner.run(all);
  if (study.plan.once) return measured;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_short(study.options, measured[i])) all[i] = timed_case(study.options, study.title, all[i], 0);
    const bool is_small = count_of(measured[i]).value_or(most_kept_tetrahedra + 1) <= most_kept_tetrahedra;
    if (study.plan.keeps_meshes && is_small) all[i].mesh_ending = mesh_format;
  }
  return study.runner.run(all);
}

/// \pre its mesh was kept, if the case has not failed
InsideQuality measure_inside(const bench::Runner& runner, const bench::MeasuredCase& measured) {
  if (measured.failed()) return {};
  const mesh::TetMesh inside = inside_cells(results::mesh_of(runner, measured));
  return {inside.tetrahedra.size(), bench::measure_quality(inside)};
}

void measure_source(const SourceStudy& study, std::vector<QualityRow>& rows, std::vector<EvenSurface>& surfaces) {
  const EvenSurface& surface = surfaces.emplace_back(find_surface(study));
  const std::vector<double> edge_lengths = edge_lengths_of(study, surface);
  std::vector<bench::MeasuredCase> measured = run_variants(study, surface, edge_lengths);
  const std::uint64_t reference = measured.front().first.counts.tetrahedra;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const QualityVariant& variant = study.plan.variants[i];
    std::optional<InsideQuality> inside;
    if (variant.measures_inside) inside = measure_inside(study.runner, measured[i]);
    rows.push_back({{std::move(measured[i])},
                    study.source.name,
                    variant.labels,
                    edge_lengths[i],
                    reference,
                    inside,
                    study.plan.equal_counts ? tolerance_of_equal_counts : tolerance_of_one_edge_length});
  }
}

std::vector<std::string> study_definitions() {
  return {
      "r: the paper's measure, ((1/6) sum of squared edges)^(3/2) / (8.48528 volume); 1 is the regular tetrahedron.",
      "Dihedral angles: the smallest and the largest of the whole mesh, in degrees.",
      "Aspect ratio: the longest edge over 2 sqrt(6) times the radius of the inscribed sphere, as in VTK and Verdict.",
      "HXT improves its inverse. The regular tetrahedron's is 1.",
      "Radius-edge ratio: the circumscribed sphere's radius over the shortest edge, as in TetGen; regular: 0.612.",
      "Surface: triangles of nearly one size. Our tetrahedra inside have edges of the same length.",
      "It is kept if its angles are at least 25 degrees and nine tenths of its edges agree within a factor of 2.",
      "Otherwise it is remeshed.",
      "Seconds: meshing with improvement, without reading and writing; one thread.",
  };
}

/// The columns that identify a row.
RowColumns<QualityRow> label_columns(const StudyPlan& plan) {
  RowColumns<QualityRow> columns = {{label_column("model"), &QualityRow::model}};
  for (std::size_t i = 0; i < plan.labels.size(); ++i)
    columns.push_back({plan.labels[i], [i](const QualityRow& row) { return row.labels.at(i); }});
  return columns;
}

Cell improve_seconds_cell(const QualityRow& row) {
  return row.ok() ? Cell(bench::median(samples_of(row.measured, stage_seconds(Stage::improve)))) : Cell();
}

/// Million tetrahedra per second, if the clock could measure it.
Cell speed_cell(const QualityRow& row) {
  const auto seconds = seconds_of(row);
  const double millions = static_cast<double>(row.measured.first.counts.tetrahedra) / 1e6;
  return seconds && seconds->value > 0 ? Cell(millions / seconds->value) : Cell();
}

ResultTable quality_table(const StudyPlan& plan, std::span<const QualityRow> rows) {
  const auto figure = [](Column column, double (*value)(const bench::Quality&)) {
    return run_column(std::move(column), [value](const RunRecord& run) { return Cell(value(run.quality)); });
  };
  using Q = const bench::Quality&;
  RowColumns<QualityRow> columns = label_columns(plan);
  append(columns,
         RowColumns<QualityRow>{
             status_column(),
             count_column("tetrahedra", &MeshCounts::tetrahedra),
             figure(figure_column("mean_r"), [](Q q) { return q.r.mean; }),
             figure(figure_column("median_r"), [](Q q) { return q.r.median; }),
             figure(figure_column("p99_r", "99% of r below"), [](Q q) { return q.r.p99; }),
             figure(figure_column("worst_r"), [](Q q) { return q.r.max; }),
             figure(figure_column("smallest_dihedral", "", "degrees"), [](Q q) { return q.dihedral_degrees.min; }),
             figure(figure_column("largest_dihedral", "", "degrees"), [](Q q) { return q.dihedral_degrees.max; }),
             figure(figure_column("mean_aspect", "mean aspect ratio"), [](Q q) { return q.aspect_ratio.mean; }),
             figure(figure_column("worst_aspect", "worst aspect ratio"), [](Q q) { return q.aspect_ratio.max; }),
             figure(figure_column("mean_radius_edge", "mean radius-edge ratio"),
                    [](Q q) { return q.radius_edge_ratio.mean; }),
             figure(figure_column("worst_radius_edge", "worst radius-edge ratio"),
                    [](Q q) { return q.radius_edge_ratio.max; }),
             {figure_column("edge_length", "target edge length"),
              [](const QualityRow& row) { return cell_if(row.ok(), row.edge_length); }},
             {figure_column("comparable", "comparable number of tetrahedra"),
              [](const QualityRow& row) { return cell_if(row.ok(), row.is_comparable()); }},
             seconds_column(),
             {time_column("improve_seconds", "of these, improvement", "s"), improve_seconds_cell},
             {time_column("speed", "million tetrahedra per second"), speed_cell},
             reason_column()});
  return table_of_rows("quality", "Quality", columns, rows);
}

/// The rows that have tetrahedra inside measured; figures are empty if there are none.
ResultTable inside_table(const StudyPlan& plan, std::span<const QualityRow> rows) {
  using Q = const bench::Quality&;
  const auto figure = [](Column column, double (*value)(Q)) {
    return RowColumn<QualityRow>(std::move(column), [value](const QualityRow& row) {
      return cell_if(row.inside->tetrahedra > 0, value(row.inside->quality));
    });
  };
  RowColumns<QualityRow> columns = label_columns(plan);
  append(columns,
         RowColumns<QualityRow>{
             status_column(),
             {figure_column("tetrahedra"),
              [](const QualityRow& row) { return cell_if(row.ok(), row.inside->tetrahedra); }},
             figure(figure_column("mean_r"), [](Q q) { return q.r.mean; }),
             figure(figure_column("p99_r", "99% of r below"), [](Q q) { return q.r.p99; }),
             figure(figure_column("worst_r"), [](Q q) { return q.r.max; }),
             figure(figure_column("smallest_dihedral", "", "degrees"), [](Q q) { return q.dihedral_degrees.min; }),
             figure(figure_column("largest_dihedral", "", "degrees"), [](Q q) { return q.dihedral_degrees.max; })});
  std::vector<QualityRow> measured;
  std::ranges::copy_if(rows, std::back_inserter(measured),
                       [](const QualityRow& row) { return row.inside.has_value(); });
  return table_of_rows("inside", "Inside, away from the surface", columns, measured);
}

/// One row per bin. All histograms have the same number of bins.
template <class HistogramOf>
ResultTable histogram_table(const StudyPlan& plan, std::span<const QualityRow> rows, std::string name,
                            std::string title, const std::string& unit, HistogramOf histogram_of) {
  ResultTable table = table_of(std::move(name), std::move(title), {}, true);
  const RowColumns<QualityRow> labels = label_columns(plan);
  for (const auto& label : labels) table.columns.push_back(label.column);
  append(table.columns, std::vector<Column>{figure_column("low", "from", unit), figure_column("high", "to", unit),
                                            figure_column("count"), figure_column("percent")});
  for (const QualityRow& row : rows) {
    if (!row.ok()) continue;
    const bench::Histogram& h = histogram_of(row.measured.first.quality);
    const auto total = static_cast<double>(std::accumulate(h.counts.begin(), h.counts.end(), std::uint64_t{0}));
    for (std::size_t bin = 0; bin < h.counts.size(); ++bin) {
      ResultRow& made = table.rows.emplace_back();
      made.runs = {runs_of(row).front()};
      for (const auto& label : labels) made.cells.push_back(label.cell(row));
      const double percent = total > 0 ? 100 * static_cast<double>(h.counts[bin]) / total : 0;
      append(made.cells, cells(h.edges[bin], h.edges[bin + 1], h.counts[bin], percent));
    }
  }
  return table;
}

std::string coordinates(const Point3& p) {
  return "(" + rounded(p.x, 5) + ", " + rounded(p.y, 5) + ", " + rounded(p.z, 5) + ")";
}

ResultTable surfaces_table(std::span<const EvenSurface> surfaces) {
  ResultTable table = table_of(
      "surfaces", "The surfaces",
      {label_column("model"), figure_column("edge_length"), figure_column("vertices"), figure_column("triangles"),
       figure_column("made"), figure_column("smallest_angle", "smallest angle of a triangle", "degrees"),
       figure_column("smallest_angle_at", "at"),
       figure_column("smallest_facet_angle", "smallest angle between facets", "degrees"),
       figure_column("smallest_facet_angle_at", "at")});
  for (const EvenSurface& s : surfaces)
    add_row(table, {}, s.model, s.edge_length, s.vertices, s.triangles, s.remeshed ? "remeshed" : "kept",
            s.angles.planar.degrees, coordinates(s.angles.planar.at), s.angles.dihedral.degrees,
            coordinates(s.angles.dihedral.at));
  return table;
}

}  // namespace

bool QualityRow::is_comparable() const {
  const auto tetrahedra = static_cast<double>(measured.first.counts.tetrahedra);
  return std::abs(tetrahedra / static_cast<double>(reference) - 1) <= tolerance;
}

ExperimentResult study_result(const StudyPlan& plan, std::span<const QualityRow> rows,
                              std::span<const EvenSurface> surfaces) {
  ExperimentResult result{.how = plan.once ? once() : Circumstances(), .definitions = study_definitions()};
  append(result.definitions, plan.definitions);
  result.tables = {
      quality_table(plan, rows),
      histogram_table(plan, rows, "r_histogram", "Histogram of r", "",
                      [](const bench::Quality& q) -> const bench::Histogram& { return q.r.histogram; }),
      histogram_table(plan, rows, "dihedral_histogram", "Histogram of the dihedral angles", "degrees",
                      [](const bench::Quality& q) -> const bench::Histogram& { return q.dihedral_degrees.histogram; }),
      surfaces_table(surfaces)};
  if (std::ranges::any_of(plan.variants, &QualityVariant::measures_inside))
    result.tables.insert(result.tables.begin(), inside_table(plan, rows));
  for (const QualityRow& row : rows) {
    add_problem_of(row, result);
    if (row.ok() && !row.is_comparable())
      add_problem(result,
                  row.measured.asked.name + ": " + with_separators(row.measured.first.counts.tetrahedra) +
                      " tetrahedra are not comparable: no edge length was found that makes about " +
                      with_separators(row.reference),
                  false);
  }
  plan.conclude(result);
  return result;
}

ExperimentResult measure_study(const ExperimentOptions& options, bench::Runner& runner, const StudyPlan& plan) {
  const std::vector<SurfaceFile> sources = sources_of(options, plan);
  check_something_is_measured(sources.size(), plan.experiment);
  std::vector<QualityRow> rows;
  std::vector<EvenSurface> surfaces;
  std::vector<std::string> problems;
  for (const SurfaceFile& source : sources) {
    const std::string title =
        source.name + ", " + with_separators(static_cast<std::uint64_t>(options.tetrahedra)) + " tetrahedra";
    try {
      measure_source({options, runner, plan, source, title}, rows, surfaces);
    } catch (const Error& error) {
      problems.push_back(title + ": " + error.what());  // the other sources are still measured
    }
  }
  ExperimentResult result = study_result(plan, rows, surfaces);
  if (!plan.once) result.definitions.push_back(short_case_words(options));
  for (const std::string& problem : problems) add_problem(result, problem);
  for (const QualityRow& row : rows)
    if (plan.keeps_meshes && row.ok() && !row.measured.asked.mesh_ending.empty())
      result.meshes.push_back(keep_mesh(runner, row.measured, row.model + ", " + row.labels.back()));
  return result;
}

}  // namespace ccdt::experiments
