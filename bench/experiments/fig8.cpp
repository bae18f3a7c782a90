#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "baselines/mesher.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

constexpr int size_count = 8;  ///< over two decades: a factor of 1.93 from one to the next

/// A way to mesh the coarsest sizes: their number at small scales, and at scales where claims are judged. With the same
/// scatter, the interval of an exponent is half as wide with seven sizes as with five.
struct Strategy {
  std::string label, mesher, words;
  int sizes, sizes_from_paper_scale = sizes;
};
constexpr double paper_scale = 50000;  ///< tetrahedra

const std::vector<Strategy> strategies = {
    {"with check", "ccdt", "--delaunay insert --face-protection on", size_count},
    {"with check, wrap", "ccdt", "--delaunay wrap --face-protection on", 5, 7},
    {"without check", "ccdt", "--delaunay insert --face-protection off", 5},
    {"without check, paper's grid", "ccdt", "--delaunay insert --face-protection off --locator grid", 5, 7},
    {"CGAL Delaunay, same vertices", "cgal-delaunay", "", 6},
    {"TetGen, its own vertices", "tetgen", "", 5, 7},
    {"CGAL Mesh_3, its own vertices", "cgal-mesh3", "--improve none", 3}};

const std::vector<std::string> definitions = {
    "Models at uniform density: the lattice has the edge length of the surface everywhere (--grading 0).",
    "Seconds of the CDT: the stages delaunay, face_check, front and label of a run.",
    "With check: Delaunay by insertion. Wrap: Delaunay face by face in a uniform grid, as in the paper.",
    "Without check: Delaunay by insertion, and every face goes through the front.",
    "Paper's grid: the front finds its vertices with the uniform grid of section 4 (--locator grid).",
    "Seconds of the other meshers: the call of the library that makes the mesh.",
    "Same vertices: all vertices of our mesh with the check. Its own: refined to the edge length of the surface.",
    "All other options are the defaults; the records of the runs list them.",
    "Wrap's Delaunay stage does not include the tetrahedralization of the input alone, which edge protection needs.",
    "Exponent: slope of the logarithms of median seconds over those of vertices; 1 is linear.",
    "Slope: that of the straight line through the median seconds over the vertices.",
    "R2: the share of the variance that the line explains.",
    "Intervals of both are Student's t for 95% confidence.",
    "Mesh_3 takes part from 50,000 tetrahedra on (--scale paper): because of small features, it cannot make fewer.",
};

using Series = std::span<const Fig8Row>;

/// The growth of some seconds of a series with the number of vertices.
struct Fit {
  Series series;
  std::string quantity;
  std::vector<double> vertices = {}, medians = {};  ///< points of successful runs that took measurable time
  bench::LineFit line = {}, power = {};
};

/// An end of the straight line through the points.
struct LineEnd {
  Series series;
  double vertices, seconds;
};

std::vector<std::string> runs_of(const Fit& fit) {
  return all_runs_of(fit.series);
}
std::vector<std::string> runs_of(const LineEnd& end) {
  return all_runs_of(end.series);
}

/// The columns that name the series of a row.
template <class Row>
RowColumns<Row> series_columns(const Fig8Row& (*of)(const Row&), const RowColumns<Row>& more) {
  RowColumns<Row> columns = {{label_column("model"), [of](const Row& row) { return of(row).model; }},
                             {label_column("mesher"), [of](const Row& row) { return mesher_of(of(row)); }},
                             {label_column("strategy"), [of](const Row& row) { return of(row).strategy; }}};
  append(columns, more);
  return columns;
}

template <class Row>
const Fig8Row& first_point(const Row& row) {
  return row.series.front();
}

Estimate in_microseconds(const Estimate& e) {
  return {1e6 * e.value, 1e6 * e.low, 1e6 * e.high};
}

const RowColumns<Fit> fit_columns = series_columns<Fit>(
    first_point,
    {{label_column("quantity", "seconds of"), &Fit::quantity},
     {figure_column("points", "sizes"), [](const Fit& fit) { return fit.vertices.size(); }},
     {time_column("exponent"), [](const Fit& fit) { return fit.power.slope; }},
     {time_column("exponent_r2", "R2 of the exponent"), [](const Fit& fit) { return fit.power.r_squared; }},
     {time_column("microseconds_per_vertex", "slope per vertex", "us"),
      [](const Fit& fit) { return in_microseconds(fit.line.slope); }},
     {time_column("seconds_at_zero", "", "s"), [](const Fit& fit) { return fit.line.intercept; }},
     {time_column("r2", "R2 of the line"), [](const Fit& fit) { return fit.line.r_squared; }}});

const RowColumns<Fig8Row> point_columns =
    series_columns<Fig8Row>([](const Fig8Row& row) -> const Fig8Row& { return row; },
                            {status_column(),
                             {figure_column("edge_length", "", "mm"), &Fig8Row::edge_length},
                             count_column("vertices", &MeshCounts::vertices),
                             count_column("tetrahedra", &MeshCounts::tetrahedra),
                             seconds_column(),
                             reason_column()});

const RowColumns<LineEnd> line_columns = series_columns<LineEnd>(
    first_point,
    {{figure_column("vertices"), &LineEnd::vertices}, {time_column("seconds", "", "s"), &LineEnd::seconds}});

/// None with fewer than three points.
void add_fit(Series series, const char* quantity, const cases::SecondsOf& seconds, std::vector<Fit>& fits) {
  Fit fit{series, quantity};
  for (const Fig8Row& row : series) {
    if (!row.ok()) continue;
    const double median = bench::median(samples_of(row.measured, seconds));
    if (median <= 0) continue;  // shorter than a tick of the clock
    fit.vertices.push_back(static_cast<double>(row.measured.first.counts.vertices));
    fit.medians.push_back(median);
  }
  if (fit.vertices.size() < 3) return;
  fit.line = bench::fit_line(fit.vertices, fit.medians);
  fit.power = bench::fit_power(fit.vertices, fit.medians);
  fits.push_back(std::move(fit));
}

std::vector<Fit> fits_of(Series series) {
  std::vector<Fit> fits;
  const bool is_ours = series.front().measured.asked.mesher == "ccdt";
  add_fit(series, is_ours ? "cdt" : "mesh", series.front().seconds, fits);
  if (is_ours) add_fit(series, "delaunay", &StageSeconds::delaunay, fits);
  if (series.front().strategy.starts_with("without check")) add_fit(series, "front", &StageSeconds::front, fits);
  return fits;
}

std::string finding_of(Series series, const std::vector<Fit>& fits) {
  const std::string who = series.front().model + ", " + series.front().strategy + ": ";
  if (fits.empty()) return who + "too few sizes for a fit";
  const Estimate& exponent = fits.front().power.slope;
  return who + "the exponent is " + with_interval(exponent) + "; that it is at most " + rounded(claimed_exponent) +
         ": " +
         choose(is_at_most(exponent, claimed_exponent), "holds", "undecided, the bound is within the interval",
                "does not hold");
}

/// The chosen meshers of this build, and those that the user describes.
std::vector<Strategy> strategies_of(const ExperimentOptions& options) {
  std::vector<Strategy> asked;
  std::ranges::copy_if(strategies, std::back_inserter(asked),
                       [&](const Strategy& s) { return is_timed(options, s.mesher); });
  for (const std::string& file : described_meshers(options))
    asked.push_back({baselines::mesher(file).name + ", its own vertices", file, "", 4, 4});
  return asked;
}

/// A size of a model.
struct ModelSize {
  int number;  ///< from 0, the coarsest
  double edge_length;
  std::filesystem::path surface;
  std::filesystem::path vertices;  ///< of our mesh
};

cases::Case case_of(const ExperimentOptions& options, const PaperModel& model, const ModelSize& size,
                    const Strategy& strategy) {
  const bool is_ours = strategy.mesher == "ccdt", takes_vertices = strategy.mesher == "cgal-delaunay";
  return single_case(options, joined({model.name, strategy.label, "edge length " + rounded(size.edge_length)}),
                     strategy.mesher, takes_vertices ? size.vertices : size.surface,
                     words_of(strategy.words + (is_ours ? " --improve none --grading 0" : "")));
}

/// Sizes from a tenth to ten times the wanted number of tetrahedra, within the limits of the solid. Our mesh of each is
/// made once, for its vertices.
std::vector<ModelSize> sizes_of(const ExperimentOptions& options, const PaperModel& model, cases::Runner& runner) {
  std::vector<ModelSize> sizes;
  const auto solid = std::ranges::find(models::solids(), model.name, &models::Solid::name);
  for (int i = 0; i < size_count; ++i) {
    const double decades = 2 * static_cast<double>(i) / (size_count - 1) - 1;
    const double edge_length = edge_factor(options) * model.edge_length * std::pow(10, -decades / 3);
    if (edge_length < solid->finest || edge_length > solid->coarsest) continue;
    const std::string file = "fig8-" + std::string(model.name) + "-" + std::to_string(i) + ".poly";
    ModelSize& size = sizes.emplace_back(i, edge_length, options.folder / "models" / file);
    io::write_plc(models::make_solid(model.name, edge_length), size.surface);
    cases::Case ours = case_of(options, model, size, strategies.front());
    ours.mesh_ending = ".node";
    size.vertices = options.folder / mesh_file(runner.run(ours));
  }
  return sizes;
}

/// Adds the rows of a model: strategy by strategy, each from the coarsest size.
void plan_model(const ExperimentOptions& options, const PaperModel& model, cases::Runner& runner,
                std::vector<Fig8Row>& rows) {
  const std::vector<ModelSize> sizes = sizes_of(options, model, runner);
  for (const Strategy& strategy : strategies_of(options)) {
    const cases::SecondsOf seconds = strategy.mesher == "ccdt" ? cdt_seconds : whole_seconds;
    const int sizes_of_strategy = options.tetrahedra < paper_scale ? strategy.sizes : strategy.sizes_from_paper_scale;
    for (const ModelSize& size : sizes) {
      if (size.number >= sizes_of_strategy) continue;
      const std::string group = "fig8 " + size.surface.stem().string();
      const cases::Case asked =
          timed_case(options, group, case_of(options, model, size, strategy), usual_precision, seconds);
      rows.push_back({{{asked}, seconds}, model.name, strategy.label, size.edge_length});
    }
  }
}

}  // namespace

ExperimentResult fig8_result(std::span<const Fig8Row> rows) {
  ExperimentResult result{.definitions = definitions};
  std::vector<Fit> fits;
  std::vector<LineEnd> lines;
  for (const Series series : neighbors(
           rows, [](const Fig8Row&a, const Fig8Row&b) { return a.model == b.model && a.strategy == b.strategy; })) {
    const std::vector<Fit> of_series = fits_of(series);
    result.findings.push_back(finding_of(series, of_series));
    append(fits, of_series);
    if (of_series.empty()) continue;
    const Fit& fit = of_series.front();
    for (const double vertices : {std::ranges::min(fit.vertices), std::ranges::max(fit.vertices)})
      lines.push_back({series, vertices, fit.line.intercept + vertices * fit.line.slope.value});
  }
  result.tables = {table_of_rows("fits", "Growth of the seconds with the number of vertices", fit_columns, fits),
                   table_of_rows("points", "Seconds against size", point_columns, rows),
                   table_of_rows("lines", "Straight lines through the points", line_columns, lines, true)};
  for (const Fig8Row& row : rows) add_problem_of(row, result);
  return result;
}

ExperimentResult measure_fig8(const ExperimentOptions& options, cases::Runner& runner) {
  std::vector<Fig8Row> rows;
  for (const PaperModel& model : paper_models)
    if (is_asked_for(options, model.name)) plan_model(options, model, runner, rows);
  check_something_is_measured(rows.size(), "fig8");
  measure_rows(runner, rows);
  ExperimentResult result = fig8_result(rows);
  result.definitions.push_back(repetition_words(options));
  return result;
}

}  // namespace ccdt::experiments
