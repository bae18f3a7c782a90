#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "baselines/mesher.h"
#include "bench/experiments/growth.h"
#include "bench/experiments/surfaces.h"
#include "bench/experiments/timing_experiments.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

/// The sizes of a model, from a coarse one to a number of tetrahedra, given in multiples of the wanted number. With the
/// check, each model covers the three decades that a fit of work needs. Runs without it take ten times as long, so only
/// the model with the fewest vertices covers them.
struct SizeRange {
  std::string_view model;
  double coarsest;  ///< edge length, mm
  double most, most_without_check;
};
constexpr std::array<SizeRange, 3> ranges = {
    {{"piston", 14, 50, 5}, {"bracket", 7.5, 40, 40}, {"stepping-pole", 6, 70, 12}}};
/// Limits for runs that must take minutes and need no verdicts.
constexpr double small_scale = 50000, most_at_small_scales = 1.5, coarsest_at_small_scales = 8;

/// A way to mesh, and the size of its largest mesh of a model, in multiples of the wanted number of tetrahedra.
struct Strategy {
  std::string label, mesher, words;
  bench::SecondsOf seconds = whole_seconds;
  double most = 0;
  double SizeRange::*most_of_model = &SizeRange::most;
};
constexpr double all_sizes = 1e6;

const std::vector<Strategy> strategies = {
    {"paper, with check", "ccdt", "--strategies paper --face-protection on", cdt_seconds, all_sizes},
    {"paper, without check", "ccdt", "--strategies paper --face-protection off", cdt_seconds, all_sizes,
     &SizeRange::most_without_check},
    {"default, with check", "ccdt", "--face-protection on", cdt_seconds, all_sizes},
    {"Delaunay refinement, ours", "ccdt", "--lattice refinement", whole_seconds, 10},
    {"TetGen, its own vertices", "tetgen", "", whole_seconds, 10},
    {"CGAL Mesh_3, its own vertices", "cgal-mesh3", "--improve none", whole_seconds, 1}};

/// From one size to the next, tetrahedra grow by this factor: four sizes in a decade.
const double step = std::pow(10, 0.25);

const std::vector<std::string> fig8_definitions = {
    "Models at uniform density: the lattice has the edge length of the surface everywhere (--grading 0).",
    "Seconds of the CDT: the stages delaunay, face_check, front and label of a run.",
    "Paper (--strategies paper): Delaunay face by face in a grid, the front in a grid, the paper's visibility tests.",
    "Default: the engine as it is used, with Delaunay tetrahedralization by insertion and lattice cores.",
    "Delaunay refinement, ours: circumcenters instead of a lattice, on the same surface; seconds of the whole mesh.",
    "Seconds of the other meshers: the call of the library that makes the mesh.",
    "All strategies and sizes run in one random order, so that a drift of the machine does not change an exponent.",
    "Work: exact counts of what a stage did. They have no noise; the interval of their exponents comes from bends.",
    "Exponent: slope of the logarithms over those of the size, with the interval of Student's t for 95%.",
    "Linear: the whole interval is within 0.1 of 1.",
    "A fit of times is judged if it spans two decades and eight sizes; a fit of work, if it spans three decades.",
    "A fit is not judged if the sizes scatter by more than 15% around it.",
    "Better: n or n log n, if one makes the measurements at least twenty times as likely; otherwise undecided.",
    "Wrap's Delaunay stage does not include the tetrahedralization of the input alone, which edge protection needs.",
    "Meshes with more than twice the wanted number of tetrahedra are not verified.",
    "Mesh_3 takes part from 50,000 tetrahedra on (--scale full): because of small features, it cannot make fewer.",
};

using Fig8Series = std::span<const Fig8Row>;

/// A measured quantity of a run that grows with the size.
struct Quantity {
  std::string name;
  const char *kind, *over;  ///< "time" or "work"; "vertices" or "front tetrahedra"
  std::function<double(const bench::MeasuredCase&)> of;
  std::uint64_t MeshCounts::*size;
};

const std::string of_time = "time", of_work = "work";

Quantity time_of(std::string name, bench::SecondsOf seconds, const char* over = "vertices",
                 std::uint64_t MeshCounts::*size = &MeshCounts::vertices) {
  return {
      std::move(name), of_time.c_str(), over,
      [seconds = std::move(seconds)](const bench::MeasuredCase& m) { return bench::median(samples_of(m, seconds)); },
      size};
}

Quantity work_of(std::string name, Stage stage, std::uint64_t Work::*count, const char* over = "vertices",
                 std::uint64_t MeshCounts::*size = &MeshCounts::vertices) {
  return {
      std::move(name), of_work.c_str(), over,
      [stage, count](const bench::MeasuredCase& m) { return static_cast<double>(m.first.costs[stage].work.*count); },
      size};
}

/// The quantities to fit. A stage that did nothing has no fit.
std::vector<Quantity> quantities_of(const Fig8Row& row) {
  if (row.measured.asked.mesher != "ccdt" || row.strategy.starts_with("Delaunay refinement"))
    return {time_of("mesh", row.seconds)};
  const char* const per = "front tetrahedra";
  std::vector<Quantity> all = {time_of("cdt", row.seconds), time_of("delaunay", stage_seconds(Stage::delaunay)),
                               time_of("front", stage_seconds(Stage::front), per, &MeshCounts::front_tetrahedra)};
  for (const auto& [name, count] : {std::pair("Delaunay: vertices examined", &Work::vertices_examined),
                                    {"Delaunay: grid cells", &Work::grid_cells},
                                    {"Delaunay: cells created", &Work::cells_created}})
    all.push_back(work_of(name, Stage::delaunay, count));
  for (const auto& [name, count] : {std::pair("front: candidates", &Work::front_candidates),
                                    {"front: visibility tests", &Work::visibility_tests},
                                    {"front: grid cells", &Work::grid_cells}})
    all.push_back(work_of(name, Stage::front, count, per, &MeshCounts::front_tetrahedra));
  return all;
}

/// The growth of a quantity in a series.
struct SeriesFit : Fit {
  Fig8Series series;
  Quantity of;
};

/// An end of the straight line through the points.
struct LineEnd {
  Fig8Series series;
  double vertices, seconds;
};

std::vector<std::string> runs_of(const SeriesFit& fit) {
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

bool is_time(const Quantity& quantity) {
  return quantity.kind == of_time;
}

/// The columns of fits of times or of work, whose exponents change with the machine or do not.
RowColumns<SeriesFit> fit_columns(Column (*exponent_column)(std::string, std::string, std::string)) {
  RowColumns<SeriesFit> columns = series_columns<SeriesFit>(
      first_point, {{label_column("quantity", "of"), &SeriesFit::quantity},
                    {label_column("over"), [](const SeriesFit& fit) { return std::string(fit.of.over); }}});
  append(columns, growth_columns(exponent_column));
  append(columns,
         RowColumns<SeriesFit>{
             {exponent_column("per_unit", "slope per unit", ""),
              [](const SeriesFit& fit) { return (is_time(fit.of) ? 1e6 : 1) * fit.growth.line.slope.value; }},
             {note_column("better", "n or n log n"), [](const Fit& fit) { return words_of(fit.growth.better); }}});
  append(columns, verdict_columns());
  return columns;
}

const RowColumns<Fig8Row> fig8_point_columns =
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

void add_fit(Fig8Series series, const Quantity& quantity, std::vector<SeriesFit>& fits) {
  std::vector<double> sizes, values;
  for (const Fig8Row& row : series) {
    if (!row.ok() || row.measured.counted.empty()) continue;
    sizes.push_back(static_cast<double>(row.measured.first.counts.*quantity.size));
    values.push_back(quantity.of(row.measured));
  }
  std::optional<Fit> fit = fit_of(quantity.name, sizes, values, is_time(quantity) ? rule_for_times : rule_for_work);
  if (fit) fits.push_back({*std::move(fit), series, quantity});
}

std::string finding_of(const SeriesFit& fit) {
  const std::string who = fit.series.front().model + ", " + fit.series.front().strategy + ", " + fit.quantity + ": ";
  return who + "the exponent is " + with_interval(fit.growth.power.slope) + ": " +
         choose(is_linear(fit.growth.power.slope), "linear", "undecided, a bound is within the interval",
                "not linear") +
         "; " +
         (fit.growth.better == Law::cannot_tell ? "n and n log n cannot be told apart"
                                                : "better described by " + words_of(fit.growth.better));
}

/// The chosen meshers of this build, and those that the user describes.
std::vector<Strategy> strategies_of(const ExperimentOptions& options) {
  std::vector<Strategy> asked;
  std::ranges::copy_if(strategies, std::back_inserter(asked),
                       [&](const Strategy& s) { return is_timed(options, s.mesher); });
  for (const std::string& file : described_meshers(options))
    asked.push_back({baselines::mesher(file).name + ", its own vertices", file, "", whole_seconds, 1});
  return asked;
}

/// A size of a model.
struct ModelSize {
  double edge_length;
  double tetrahedra;  ///< about, in the wanted number
  std::filesystem::path surface;
};

std::vector<ModelSize> sizes_of(const ExperimentOptions& options, const PaperModel& model, const SizeRange& range) {
  const double finest = std::ranges::find(models::solids(), model.name, &models::Solid::name)->finest;
  const bool is_small = options.tetrahedra < small_scale;
  const double most = is_small ? most_at_small_scales : range.most,
               coarsest = is_small ? std::min(coarsest_at_small_scales, range.coarsest) : range.coarsest;
  std::vector<ModelSize> sizes;
  for (double edge_length = coarsest; edge_length >= finest; edge_length /= std::cbrt(step)) {
    const double tetrahedra = std::pow(edge_factor(options) * model.edge_length / edge_length, 3);
    if (tetrahedra > most) break;
    const std::string file = "fig8-" + std::string(model.name) + "-" + std::to_string(sizes.size()) + ".poly";
    sizes.push_back({edge_length, tetrahedra, options.folder / "models" / file});
    io::write_plc(models::make_solid(model.name, edge_length), sizes.back().surface);
  }
  return sizes;
}

bench::Case case_of(const ExperimentOptions& options, const PaperModel& model, const ModelSize& size,
                    const Strategy& strategy) {
  constexpr double most_verified = 2;
  const bool is_ours = strategy.mesher == "ccdt";
  bench::Case one = single_case(
      options, joined({model.name, strategy.label, "edge length " + rounded(size.edge_length)}), strategy.mesher,
      size.surface, words_of(strategy.words + (is_ours ? " --improve none --steiner keep --grading 0" : "")));
  one.group = "fig8";
  one.seconds = strategy.seconds;
  one.verify = size.tetrahedra <= most_verified;
  return one;
}

/// Adds the rows of a model: strategy by strategy, each from the coarsest size.
void plan_model(const ExperimentOptions& options, const PaperModel& model, std::vector<Fig8Row>& rows) {
  const SizeRange& range = *std::ranges::find(ranges, model.name, &SizeRange::model);
  const std::vector<ModelSize> sizes = sizes_of(options, model, range);
  for (const Strategy& strategy : strategies_of(options))
    for (const ModelSize& size : sizes)
      if (size.tetrahedra <= std::min(strategy.most, range.*strategy.most_of_model)) {
        Fig8Row& row = rows.emplace_back();
        row.measured.asked = case_of(options, model, size, strategy);
        row.seconds = strategy.seconds;
        row.model = model.name, row.strategy = strategy.label;
        row.edge_length = size.edge_length;
      }
}

}  // namespace

ExperimentResult fig8_result(std::span<const Fig8Row> rows) {
  ExperimentResult result{.definitions = fig8_definitions};
  std::vector<SeriesFit> times, work;
  std::vector<LineEnd> lines;
  for (const Fig8Series series : neighbors(
           rows, [](const Fig8Row&a, const Fig8Row&b) { return a.model == b.model && a.strategy == b.strategy; })) {
    const std::size_t before = times.size();
    for (const Quantity& quantity : quantities_of(series.front()))
      add_fit(series, quantity, is_time(quantity) ? times : work);
    if (times.size() == before) continue;
    const Growth& growth = times[before].growth;
    for (const double vertices : {growth.least, growth.most})
      lines.push_back({series, vertices, growth.line.intercept + vertices * growth.line.slope.value});
  }
  for (const std::vector<SeriesFit>* fits : {&work, &times}) {
    for (const SeriesFit& fit : *fits)
      if (fit.is_judged()) result.findings.push_back(finding_of(fit));
    const auto others = std::ranges::count_if(*fits, std::not_fn(&Fit::is_judged));
    if (others > 0)
      result.findings.push_back(with_separators(static_cast<std::uint64_t>(others)) + " fits of " +
                                std::string(fits == &work ? "work" : "times") +
                                " are not judged; their rows say why, most often because the range is too short");
  }
  result.tables = {table_of_rows("work", "Growth of exact counts", fit_columns(figure_column), work),
                   table_of_rows("fits", "Growth of the seconds", fit_columns(time_column), times),
                   table_of_rows("points", "Seconds against size", fig8_point_columns, rows),
                   table_of_rows("lines", "Straight lines through the points", line_columns, lines, true)};
  for (const Fig8Row& row : rows) add_problem_of(row, result);
  return result;
}

ExperimentResult measure_fig8(const ExperimentOptions& options, bench::Runner& runner) {
  constexpr double precision = 0;  // six runs are enough: the interval of a fit comes from the scatter of the sizes
  std::vector<Fig8Row> rows;
  for (const PaperModel& model : paper_models)
    if (is_chosen(options, model.name)) plan_model(options, model, rows);
  check_something_is_measured(rows.size(), "fig8");
  measure_rows(runner, rows);
  for (Fig8Row& row : rows)
    if (is_short(options, row.measured))
      row.measured.asked = timed_case(options, "fig8", row.measured.asked, precision, row.seconds);
  measure_rows(runner, rows);
  ExperimentResult result = fig8_result(rows);
  result.definitions.push_back("Short cases are run " + std::to_string(options.runs) + " times after a warm-up.");
  result.definitions.push_back(short_case_words(options));
  return result;
}

}  // namespace ccdt::experiments
