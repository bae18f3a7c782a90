#include "bench/experiments/fig8.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "baselines/mesher.h"
#include "bench/experiments/measured_case.h"
#include "bench/experiments/surfaces.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt {
namespace {

constexpr int size_count = 8;  ///< over two decades: a factor of 1.93 from one to the next

struct Strategy {
  std::string id, label, mesher;
  std::vector<std::string> options;
  int sizes;  ///< how many, from the coarsest
};

const std::vector<Strategy>& all_strategies() {
  static const std::vector<Strategy> all = {
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
std::vector<Strategy> strategies_of(const ExperimentOptions& options) {
  std::vector<Strategy> strategies;
  std::ranges::copy_if(all_strategies(), std::back_inserter(strategies),
                       [&](const Strategy& s) { return is_timed(options, s.mesher); });
  for (const std::string& file : described_meshers(options)) {
    const std::string name = mesher(file).name;
    strategies.push_back({name, name + ", its own vertices", file, {}, 4});
  }
  return strategies;
}

double whole_seconds(const StageSeconds& seconds) {
  return seconds.mesh;
}

struct Size {
  int number;  ///< from 0, the coarsest
  double edge_length;
};

/// From a tenth of the tetrahedra that are wanted to ten times as many, within the limits of the solid.
std::vector<Size> sizes_of(const PaperModel& model, const ExperimentOptions& options) {
  std::vector<Size> sizes;
  const auto solid = std::ranges::find(solids(), model.name, &Solid::name);
  for (int i = 0; i < size_count; ++i) {
    const double decades = 2 * static_cast<double>(i) / (size_count - 1) - 1;
    const double edge_length = edge_factor(options) * model.edge_length * std::pow(10, -decades / 3);
    if (edge_length >= solid->finest && edge_length <= solid->coarsest) sizes.push_back({i, edge_length});
  }
  return sizes;
}

/// The cases of one size, one a strategy that goes that far.
std::vector<MeasuredCase> plan(const ExperimentOptions& options, const PaperModel& model, const Size& size) {
  const std::string stem = "fig8-" + std::string(model.name) + "-" + std::to_string(size.number);
  const auto surface = options.folder / "models" / (stem + ".poly");
  write_plc(make_solid(model.name, size.edge_length), surface);
  const auto mesh_of = [&](const std::string& id) { return options.folder / "meshes" / (stem + "-" + id + ".node"); };
  std::vector<MeasuredCase> cases;
  for (const Strategy& strategy : strategies_of(options)) {
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

Fig8Point point_of(const MeasuredCase& measured, const Size& size) {
  Fig8Point point{size.edge_length,      measured.first.counts, {}, {}, measured.first.status,
                  measured.first.reason, run_files(measured)};
  if (measured.failed()) return point;
  for (const RunRecord& run : measured.counted) point.samples.push_back(run.seconds);
  point.seconds =
      median_estimate(samples_of(measured.counted, measured.what.mesher == "ccdt" ? cdt_seconds : whole_seconds));
  return point;
}

void measure_size(const ExperimentOptions& options, const PaperModel& model, const Size& size, Fig8Model& result,
                  const std::function<void(const std::string&)>& announce) {
  std::vector<MeasuredCase> cases = plan(options, model, size);
  for (int number = 0; number <= options.runs; ++number)
    for (MeasuredCase& measured : cases) {
      announce(measured.stem);
      run_once(options, measured, number);
    }
  for (const MeasuredCase& measured : cases) {
    if (measured.name != "insert")  // whose vertices are the input of others
      for (const char* ending : {".node", ".ele", ".face", ".edge"})
        std::filesystem::remove(std::filesystem::path(measured.what.output).replace_extension(ending));
    std::ranges::find(result.series, measured.name, &Fig8Series::id)->points.push_back(point_of(measured, size));
  }
}

Fig8Model measure_model(const ExperimentOptions& options, const PaperModel& model,
                        const std::function<void(const std::string&)>& announce) {
  Fig8Model result{model.name, {}};
  for (const Strategy& strategy : strategies_of(options))
    result.series.push_back({strategy.id, strategy.label, mesher(strategy.mesher).name, {}, {}});
  for (const Size& size : sizes_of(model, options)) measure_size(options, model, size, result, announce);
  for (Fig8Series& series : result.series) series.fits = fit_series(series);
  return result;
}

}  // namespace

std::vector<Fig8Fit> fit_series(const Fig8Series& series) {
  std::vector<Fig8Fit> fits;
  const auto add = [&](const char* quantity, const auto& seconds_of) {
    std::vector<double> vertices, medians;
    for (const Fig8Point& point : series.points) {
      if (!point.seconds) continue;
      std::vector<double> samples;
      for (const StageSeconds& s : point.samples) samples.push_back(seconds_of(s));
      if (median(samples) <= 0) continue;  // shorter than a tick of the clock
      vertices.push_back(static_cast<double>(point.counts.vertices));
      medians.push_back(median(samples));
    }
    if (vertices.size() < 3) return;
    const auto [least, most] = std::ranges::minmax(vertices);
    fits.push_back({quantity, vertices.size(), least, most, fit_line(vertices, medians), fit_power(vertices, medians)});
  };
  if (series.mesher != "ccdt") {
    add("mesh", whole_seconds);
    return fits;
  }
  add("cdt", cdt_seconds);
  add("delaunay", [](const StageSeconds& s) { return s.delaunay; });
  if (series.id.starts_with("without_check")) add("front", [](const StageSeconds& s) { return s.front; });
  return fits;
}

std::vector<std::string> fig8_definitions() {
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

Fig8 measure_fig8(const ExperimentOptions& options, const Progress& progress) {
  Fig8 fig8;
  fig8.how = start_experiment(options);
  std::uint64_t cases = 0, done = 0;
  for (const PaperModel& model : paper_models)
    for (const Size& size : sizes_of(model, options))
      for (const Strategy& strategy : strategies_of(options))
        cases += is_asked_for(options, model.name) && size.number < strategy.sizes;
  check_something_is_measured(cases, "fig8");
  const std::uint64_t total = cases * static_cast<std::uint64_t>(options.runs + 1);
  for (const PaperModel& model : paper_models)
    if (is_asked_for(options, model.name))
      fig8.models.push_back(measure_model(
          options, model, [&](const std::string& what) { report(progress, what, std::min(done++, total), total); }));
  return fig8;
}

}  // namespace ccdt
