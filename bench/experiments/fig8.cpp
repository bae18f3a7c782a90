#include "bench/experiments/fig8.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "bench/experiments/measured_case.h"
#include "engine/io/write_plc.h"
#include "models/solids.h"

namespace ccdt {
namespace {

struct Model {
  const char* name;
  double edge_length;  ///< for about 100,000 tetrahedra
};
constexpr std::array<Model, 3> models = {{{"piston", 2.32}, {"bracket", 1.73}, {"stepping-pole", 1.62}}};
constexpr int size_count = 8;  ///< over two decades: a factor of 1.93 from one to the next

struct Strategy {
  const char* id;
  const char* label;
  std::vector<std::string> options;
  int sizes;  ///< how many, from the coarsest
  bool with_front;
};

const std::vector<Strategy>& strategies() {
  static const std::vector<Strategy> all = {
      {"insert", "with check", {"--delaunay", "insert", "--face-protection", "on"}, size_count, false},
      {"wrap", "with check, wrap", {"--delaunay", "wrap", "--face-protection", "on"}, 5, false},
      {"without_check", "without check", {"--delaunay", "insert", "--face-protection", "off"}, 5, true}};
  return all;
}

struct Size {
  int number;  ///< from 0, the coarsest
  double edge_length;
};

/// From a tenth of the tetrahedra that are wanted to ten times as many, within the limits of the solid.
std::vector<Size> sizes_of(const Model& model, const ExperimentOptions& options) {
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
std::vector<MeasuredCase> plan(const ExperimentOptions& options, const Model& model, const Size& size) {
  const std::string stem = "fig8-" + std::string(model.name) + "-" + std::to_string(size.number);
  const auto surface = options.folder / "models" / (stem + ".poly");
  write_plc(make_solid(model.name, size.edge_length), surface);
  std::vector<MeasuredCase> cases;
  for (const Strategy& strategy : strategies()) {
    if (size.number >= strategy.sizes) continue;
    std::vector<std::string> words = strategy.options;
    words.insert(words.end(), {"--improve", "none", "--grading", "0"});
    cases.push_back({strategy.id,
                     stem + "-" + strategy.id,
                     {"ccdt", surface, options.folder / "meshes" / (stem + "-" + strategy.id + ".vtu"), words}});
  }
  return cases;
}

/// How many counted runs a size gets, now that each case has run once.
int runs_of(const ExperimentOptions& options, std::span<const MeasuredCase> cases) {
  const bool is_long =
      std::ranges::any_of(cases, [](const auto& c) { return cdt_seconds(c.first.seconds) > long_run_seconds; });
  return is_long ? std::min(options.runs, counted_long_runs) : options.runs;
}

Fig8Point point_of(const MeasuredCase& measured, const Size& size) {
  Fig8Point point{size.edge_length, measured.first.counts, {}, {}, measured.first.status, measured.first.reason};
  if (measured.failed()) return point;
  for (const RunRecord& run : measured.counted) point.samples.push_back(run.seconds);
  point.cdt = median_estimate(samples_of(measured.counted, cdt_seconds));
  return point;
}

void measure_size(const ExperimentOptions& options, const Model& model, const Size& size, Fig8Model& result,
                  const std::function<void(const std::string&)>& announce) {
  std::vector<MeasuredCase> cases = plan(options, model, size);
  int runs = options.runs;
  for (int number = 0; number <= runs; ++number) {
    for (MeasuredCase& measured : cases) {
      announce(measured.stem);
      run_once(options, measured, number);
    }
    if (number == 0) runs = runs_of(options, cases);
  }
  for (const MeasuredCase& measured : cases) {
    std::filesystem::remove(measured.what.output);  // gigabytes in all
    std::ranges::find(result.series, measured.name, &Fig8Series::id)->points.push_back(point_of(measured, size));
  }
}

Fig8Model measure_model(const ExperimentOptions& options, const Model& model,
                        const std::function<void(const std::string&)>& announce) {
  Fig8Model result{model.name, {}};
  for (const Strategy& strategy : strategies()) result.series.push_back({strategy.id, strategy.label, {}, {}});
  for (const Size& size : sizes_of(model, options)) measure_size(options, model, size, result, announce);
  for (std::size_t i = 0; i < result.series.size(); ++i)
    result.series[i].fits = fit_series(result.series[i], strategies()[i].with_front);
  return result;
}

}  // namespace

std::vector<Fig8Fit> fit_series(const Fig8Series& series, bool with_front) {
  std::vector<Fig8Fit> fits;
  const auto add = [&](const char* id, double (*seconds)(const StageSeconds&)) {
    std::vector<double> vertices, medians;
    for (const Fig8Point& point : series.points) {
      if (!point.cdt) continue;
      std::vector<double> samples;
      for (const StageSeconds& s : point.samples) samples.push_back(seconds(s));
      if (median(samples) <= 0) continue;  // shorter than a tick of the clock
      vertices.push_back(static_cast<double>(point.counts.vertices));
      medians.push_back(median(samples));
    }
    if (vertices.size() >= 3) fits.push_back({id, fit_line(vertices, medians), fit_power(vertices, medians)});
  };
  add("cdt", cdt_seconds);
  add("delaunay", [](const StageSeconds& s) { return s.delaunay; });
  if (with_front) add("front", [](const StageSeconds& s) { return s.front; });
  return fits;
}

std::vector<std::string> fig8_definitions() {
  return {
      "Models at uniform density: the lattice has the edge length of the surface everywhere (--grading 0).",
      "Seconds of the CDT: the stages delaunay, face_check, front and label of a run.",
      "With check: Delaunay by insertion. Wrap: Delaunay face by face in a uniform grid, as in the paper.",
      "Without check: Delaunay by insertion, and every face goes through the front.",
      "What is not named here is done as by default; the records of the runs have all options.",
      "Wrap's Delaunay stage does not hold the tetrahedralization of the input alone, which edge protection needs.",
      "Exponent: slope of the logarithms of median seconds over those of vertices; 1 is linear.",
      "Slope: of the straight line through the median seconds over the vertices; R2: its share of the variance.",
      "Intervals of both are Student's t for 95% confidence.",
      "A size at which a CDT takes more than 30 s has at most three counted runs.",
  };
}

Fig8 measure_fig8(const ExperimentOptions& options, const Progress& progress) {
  Fig8 fig8;
  fig8.how = start_experiment(options);
  std::uint64_t cases = 0, done = 0;
  for (const Model& model : models)
    for (const Size& size : sizes_of(model, options))
      for (const Strategy& strategy : strategies())
        cases += is_asked_for(options, model.name) && size.number < strategy.sizes;
  check_something_is_measured(cases, "fig8");
  const std::uint64_t total = cases * static_cast<std::uint64_t>(options.runs + 1);
  for (const Model& model : models)
    if (is_asked_for(options, model.name))
      fig8.models.push_back(measure_model(
          options, model, [&](const std::string& what) { report(progress, what, std::min(done++, total), total); }));
  return fig8;
}

}  // namespace ccdt
