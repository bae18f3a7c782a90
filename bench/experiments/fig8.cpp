#include <algorithm>
#include <cmath>

#include "baselines/mesher.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

constexpr int size_count = 8;  ///< over two decades: a factor of 1.93 from one to the next

/// A way to mesh all sizes up to one.
struct MeshStrategy {
  std::string id, label, mesher;
  std::vector<std::string> options;
  int sizes;  ///< how many, from the coarsest
};

const std::vector<MeshStrategy>& all_strategies() {
  static const std::vector<MeshStrategy> all = {
      {"insert", "with check", "ccdt", {"--delaunay", "insert", "--face-protection", "on"}, size_count},
      {"wrap", "with check, wrap", "ccdt", {"--delaunay", "wrap", "--face-protection", "on"}, 5},
      {"without_check", "without check", "ccdt", {"--delaunay", "insert", "--face-protection", "off"}, 5},
      {"without_check_grid",
       "without check, paper's grid",
       "ccdt",
       {"--delaunay", "insert", "--face-protection", "off", "--locator", "grid"},
       5},
      {"cgal-delaunay", "CGAL Delaunay, same vertices", "cgal-delaunay", {}, 6},
      {"tetgen", "TetGen, its own vertices", "tetgen", {}, 5},
      {"cgal-mesh3", "CGAL Mesh_3, its own vertices", "cgal-mesh3", {"--improve", "none"}, 3}};
  return all;
}

/// Those of this build that are asked for.
std::vector<MeshStrategy> strategies_of(const ExperimentOptions& options) {
  std::vector<MeshStrategy> strategies;
  std::ranges::copy_if(all_strategies(), std::back_inserter(strategies),
                       [&](const MeshStrategy& s) { return is_timed(options, s.mesher); });
  for (const std::string& file : described_meshers(options)) {
    const std::string name = baselines::mesher(file).name;
    strategies.push_back({name, name + ", its own vertices", file, {}, 4});
  }
  return strategies;
}

/// A size of a model.
struct ModelSize {
  int number;  ///< from 0, the coarsest
  double edge_length;
};

/// From a tenth of the tetrahedra that are wanted to ten times as many, within the limits of the solid.
std::vector<ModelSize> sizes_of(const PaperModel& model, const ExperimentOptions& options) {
  std::vector<ModelSize> sizes;
  const auto solid = std::ranges::find(models::solids(), model.name, &models::Solid::name);
  for (int i = 0; i < size_count; ++i) {
    const double decades = 2 * static_cast<double>(i) / (size_count - 1) - 1;
    const double edge_length = edge_factor(options) * model.edge_length * std::pow(10, -decades / 3);
    if (edge_length >= solid->finest && edge_length <= solid->coarsest) sizes.push_back({i, edge_length});
  }
  return sizes;
}

/// The cases of one size, one a strategy that goes that far.
std::vector<MeasuredCase> plan(const ExperimentOptions& options, const PaperModel& model, const ModelSize& size) {
  const std::string stem = "fig8-" + std::string(model.name) + "-" + std::to_string(size.number);
  const auto surface = options.folder / "models" / (stem + ".poly");
  io::write_plc(models::make_solid(model.name, size.edge_length), surface);
  const auto mesh_of = [&](const std::string& id) { return options.folder / "meshes" / (stem + "-" + id + ".node"); };
  std::vector<MeasuredCase> cases;
  for (const MeshStrategy& strategy : strategies_of(options)) {
    if (size.number >= strategy.sizes) continue;
    std::vector<std::string> words = strategy.options;
    if (strategy.mesher == "ccdt") words.insert(words.end(), {"--improve", "none", "--grading", "0"});
    const bool takes_our_vertices = strategy.mesher == "cgal-delaunay";
    cases.push_back({strategy.id,
                     stem + "-" + strategy.id,
                     {strategy.mesher, takes_our_vertices ? mesh_of("insert") : surface, mesh_of(strategy.id), words}});
  }
  return cases;
}

Fig8Point point_of(const MeasuredCase& measured, const ModelSize& size) {
  const bool is_ours = measured.call.mesher == "ccdt";
  Fig8Point point{outcome_of(measured, is_ours ? SecondsOf(cdt_seconds) : &StageSeconds::mesh), size.edge_length};
  if (point.ok())
    for (const RunRecord& run : measured.counted) point.stages.push_back(run.seconds);
  return point;
}

void measure_size(const ExperimentOptions& options, const PaperModel& model, const ModelSize& size, StepCounter& steps,
                  Fig8Model& result) {
  std::vector<MeasuredCase> cases = plan(options, model, size);
  run_in_turn(options, cases, 0, [&](const MeasuredCase& measured, int) { steps.next(measured.stem); });
  for (const MeasuredCase& measured : cases) {
    if (measured.name != "insert")  // whose vertices are the input of others
      for (const char* ending : {".node", ".ele", ".face", ".edge"})
        std::filesystem::remove(std::filesystem::path(measured.call.output).replace_extension(ending));
    std::ranges::find(result.series, measured.name, &Fig8Series::id)->points.push_back(point_of(measured, size));
  }
}

Fig8Model measure_model(const ExperimentOptions& options, const PaperModel& model, StepCounter& steps) {
  Fig8Model result{model.name, {}};
  for (const MeshStrategy& strategy : strategies_of(options))
    result.series.push_back({strategy.id, strategy.label, baselines::mesher(strategy.mesher).name});
  for (const ModelSize& size : sizes_of(model, options)) measure_size(options, model, size, steps, result);
  for (Fig8Series& series : result.series) series.fits = fit_series(series);
  return result;
}

std::vector<std::string> definitions() {
  return {
      "Models at uniform density: the lattice has the edge length of the surface everywhere (--grading 0).",
      "Seconds of the CDT: the stages delaunay, face_check, front and label of a run.",
      "With check: Delaunay by insertion. Wrap: Delaunay face by face in a uniform grid, as in the paper.",
      "Without check: Delaunay by insertion, and every face goes through the front.",
      "Paper's grid: the front finds its vertices with the uniform grid of section 4 (--locator grid).",
      "Seconds of the other meshers: the call of the library that makes the mesh.",
      "Same vertices: all those of our mesh with the check. Its own: refined to the edge length of the surface.",
      "What is not named here is done as by default; the records of the runs have all options.",
      "Wrap's Delaunay stage does not hold the tetrahedralization of the input alone, which edge protection needs.",
      "Exponent: slope of the logarithms of median seconds over those of vertices; 1 is linear.",
      "Slope: of the straight line through the median seconds over the vertices; R2: its share of the variance.",
      "Intervals of both are Student's t for 95% confidence.",
      "Mesh_3 takes part from 50,000 tetrahedra on (--scale paper): small features of the models keep it from fewer.",
      "What takes long has at most three counted runs.",
  };
}

/// Appends a row that begins with the labels of a series.
template <class... Values>
void add_series_row(ResultTable& table, const std::string& model, const Fig8Series& series,
                    const std::vector<std::string>& runs, const Values&... values) {
  add_row(table, runs, model, series.mesher, series.label, values...);
}

std::vector<Column> series_columns(const std::vector<Column>& more) {
  std::vector<Column> columns = {label_column("model"), label_column("mesher"), label_column("strategy")};
  append(columns, more);
  return columns;
}

std::vector<std::string> all_runs(const Fig8Series& series) {
  std::vector<std::string> runs;
  for (const Fig8Point& point : series.points) append(runs, point.runs);
  return runs;
}

Estimate in_microseconds(const Estimate& e) {
  return {1e6 * e.value, 1e6 * e.low, 1e6 * e.high};
}

void add_rows(const std::string& model, const Fig8Series& series, ResultTable& points, ResultTable& fits,
              ResultTable& lines) {
  for (const Fig8Point& p : series.points)
    add_series_row(points, model, series, p.runs, name_of(p.status), p.edge_length,
                   cell_if(p.seconds.has_value(), p.counts.vertices),
                   cell_if(p.seconds.has_value(), p.counts.tetrahedra), p.seconds, p.reason);
  const std::vector<std::string> runs = all_runs(series);
  for (const Fig8Fit& fit : series.fits)
    add_series_row(fits, model, series, runs, fit.quantity, fit.points, fit.power.slope, fit.power.r_squared,
                   in_microseconds(fit.line.slope), fit.line.intercept, fit.line.r_squared);
  if (series.fits.empty()) return;
  const Fig8Fit& fit = series.fits.front();  // the ends of its straight line
  for (const double vertices : {fit.least_vertices, fit.most_vertices})
    add_series_row(lines, model, series, runs, vertices, fit.line.intercept + vertices * fit.line.slope.value);
}

void add_finding(const std::string& model, const Fig8Series& series, ExperimentResult& result) {
  const std::string who = model + ", " + series.label + ": ";
  if (series.fits.empty()) {
    result.findings.push_back(who + "too few sizes for a fit");
    return;
  }
  const Estimate& exponent = series.fits.front().power.slope;
  result.findings.push_back(who + "the exponent is " + with_interval(exponent) + "; that it is at most " +
                            rounded(claimed_exponent) + ": " +
                            choose(is_at_most(exponent, claimed_exponent), "holds",
                                   "undecided, the bound is within the interval", "does not hold"));
}

void add_problems(const std::string& model, const Fig8Series& series, ExperimentResult& result) {
  for (const Fig8Point& p : series.points)
    if (!p.seconds)
      add_problem(result, model + ", " + series.label + ", edge length " + rounded(p.edge_length) + ": " + p.failure(),
                  series.mesher == "ccdt");
}

}  // namespace

std::vector<Fig8Fit> fit_series(const Fig8Series& series) {
  std::vector<Fig8Fit> fits;
  const auto add = [&](const char* quantity, const SecondsOf& seconds_of) {
    std::vector<double> vertices, medians;
    for (const Fig8Point& point : series.points) {
      if (!point.seconds) continue;
      std::vector<double> samples;
      for (const StageSeconds& s : point.stages) samples.push_back(seconds_of(s));
      if (bench::median(samples) <= 0) continue;  // shorter than a tick of the clock
      vertices.push_back(static_cast<double>(point.counts.vertices));
      medians.push_back(bench::median(samples));
    }
    if (vertices.size() < 3) return;
    const auto [least, most] = std::ranges::minmax(vertices);
    fits.push_back({quantity, vertices.size(), least, most, bench::fit_line(vertices, medians),
                    bench::fit_power(vertices, medians)});
  };
  if (series.mesher != "ccdt") {
    add("mesh", &StageSeconds::mesh);
    return fits;
  }
  add("cdt", cdt_seconds);
  add("delaunay", &StageSeconds::delaunay);
  if (series.id.starts_with("without_check")) add("front", &StageSeconds::front);
  return fits;
}

Fig8 measure_fig8(const ExperimentOptions& options, const Progress& progress) {
  Fig8 fig8{start_experiment(options, options.runs), {}};
  std::uint64_t cases = 0;
  for (const PaperModel& model : paper_models)
    for (const ModelSize& size : sizes_of(model, options))
      for (const MeshStrategy& strategy : strategies_of(options))
        cases += is_asked_for(options, model.name) && size.number < strategy.sizes;
  check_something_is_measured(cases, "fig8");
  StepCounter steps(progress, cases * static_cast<std::uint64_t>(options.runs + 1));
  for (const PaperModel& model : paper_models)
    if (is_asked_for(options, model.name)) fig8.models.push_back(measure_model(options, model, steps));
  return fig8;
}

ExperimentResult result_of(const Fig8& fig8) {
  ResultTable fits =
      table_of("fits", "How the seconds grow with the number of vertices",
               series_columns({label_column("quantity", "seconds of"), figure_column("points", "sizes"),
                               time_column("exponent"), time_column("exponent_r2", "R2 of the exponent"),
                               time_column("microseconds_per_vertex", "slope, a vertex", "us"),
                               time_column("seconds_at_zero", "", "s"), time_column("r2", "R2 of the line")}));
  ResultTable points = table_of(
      "points", "Seconds against size",
      series_columns({label_column("status"), figure_column("edge_length", "", "mm"), figure_column("vertices"),
                      figure_column("tetrahedra"), time_column("seconds", "", "s"), note_column("reason")}));
  ResultTable lines = table_of("lines", "Straight lines through the points",
                               series_columns({figure_column("vertices"), time_column("seconds", "", "s")}), true);
  ExperimentResult result{.how = fig8.how, .definitions = definitions()};
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series) {
      add_rows(model.name, series, points, fits, lines);
      add_finding(model.name, series, result);
      add_problems(model.name, series, result);
    }
  result.tables = {fits, points, lines};
  return result;
}

}  // namespace ccdt::experiments
