#include "bench/experiments/density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/experiments/surfaces.h"
#include "engine/base/digits.h"
#include "engine/io/plc_files.h"
#include "models/solids.h"

namespace ccdt::experiments {
namespace {

const std::vector<std::string> density_definitions = {
    "Uniform: a cube with a square grid on each face, and a lattice of the same edge length.",
    "Graded: a cube whose squares shrink 128-fold toward a corner, and a lattice whose edges grow inward.",
    "The graded cube's edges keep their ratios at all sizes.",
    "Grid: all of the paper's strategies (--strategies paper). Octree: ours, with the paper's visibility tests.",
    "All faces go through the front (--face-protection off).",
    "Work: exact counts of what the front did, over the number of its tetrahedra. They have no noise.",
    "Candidates: vertices that were tried as an apex. Visibility tests: faces tested because they may hide one.",
    "Grid cells are shown, not judged: the cost is in what a cell holds, which counts as candidates and tests.",
    "Exponent: slope of the logarithms, with the interval of Student's t for 95%.",
    "At uniform density, a fit is judged if it spans at least three decades and eight sizes.",
    "At graded density, where work grows quadratically, one decade and four sizes show that it is not linear.",
};

/// A cube, and how it is filled and meshed.
struct DensitySeries {
  std::string density, locator;
  const char* solid;
  std::string words;
  double tetrahedra_of_one;  ///< about, with the longest edge
  double dimension;          ///< tetrahedra grow with this power of the longest edge over the edge length
  double longest;            ///< edge
  double first, step;        ///< of longest edge over edge length, a whole number
  double most_of_wanted;     ///< tetrahedra, as a share of the wanted number
  double most;
};
constexpr double no_limit = 1e18;
const std::vector<DensitySeries> all_series = {
    {"uniform", "grid", "cube", "--strategies paper --grading 0", 5.6, 3, 1, 3, 1.2115, 4, no_limit},
    {"graded", "grid", "graded-cube", "--strategies paper", 1500, 2, 0.5, 1, 1, 0.75, 25000},
    {"graded", "octree", "graded-cube", "--locator octree --visibility faces", 1500, 2, 0.5, 1, 1, 1, no_limit}};

/// The longest edge over the edge lengths of a series. They grow by the step's factor, and by at least one.
std::vector<int> divisions_of(const DensitySeries& series, double wanted) {
  std::vector<int> divisions;
  const double most = std::min(series.most_of_wanted * wanted, series.most);
  for (double n = series.first; series.tetrahedra_of_one * std::pow(n, series.dimension) <= most;
       n = std::max(n + 1, std::round(n * series.step)))
    divisions.push_back(static_cast<int>(n));
  return divisions;
}

using MeasuredSeries = std::span<const DensityRow>;

struct FrontWork {
  const char* name;
  std::uint64_t Work::*count;
  bool is_judged;
};
constexpr std::array<FrontWork, 3> front_works = {{{"candidates", &Work::front_candidates, true},
                                                   {"visibility tests", &Work::visibility_tests, true},
                                                   {"grid cells", &Work::grid_cells, false}}};

double work_of(const DensityRow& row, const FrontWork& work) {
  return static_cast<double>(row.measured.first.costs[Stage::front].work.*work.count);
}
double tetrahedra_of(const DensityRow& row) {
  return static_cast<double>(row.measured.first.counts.front_tetrahedra);
}

/// The growth of a count in a series.
struct DensityFit : Fit {
  MeasuredSeries series;
};
std::vector<std::string> runs_of(const DensityFit& fit) {
  return all_runs_of(fit.series);
}

RowColumns<DensityFit> density_fit_columns() {
  RowColumns<DensityFit> columns = {
      {label_column("density"), [](const DensityFit& fit) { return fit.series.front().density; }},
      {label_column("locator"), [](const DensityFit& fit) { return fit.series.front().locator; }},
      {label_column("quantity", "of"), &DensityFit::quantity}};
  append(columns, growth_columns(figure_column));
  append(columns, verdict_columns());
  return columns;
}

/// A count per tetrahedron of the front; empty if the run failed.
RowColumn<DensityRow> per_tetrahedron(const char* name, const char* title, const FrontWork& work) {
  return {figure_column(name, title), [work](const DensityRow& row) {
            return cell_if(row.ok() && tetrahedra_of(row) > 0, work_of(row, work) / tetrahedra_of(row));
          }};
}

const RowColumns<DensityRow> density_point_columns = {
    {label_column("density"), &DensityRow::density},
    {label_column("locator"), &DensityRow::locator},
    status_column(),
    {figure_column("edge_length", "longest edge"), &DensityRow::edge_length},
    count_column("vertices", &MeshCounts::vertices),
    count_column("front_tetrahedra", &MeshCounts::front_tetrahedra, "tetrahedra of the front"),
    per_tetrahedron("candidates", "candidates, per tetrahedron", front_works[0]),
    per_tetrahedron("visibility_tests", "visibility tests, per tetrahedron", front_works[1]),
    per_tetrahedron("grid_cells", "grid cells, per tetrahedron", front_works[2]),
    reason_column()};

void add_fit(MeasuredSeries series, const FrontWork& work, std::vector<DensityFit>& fits) {
  std::vector<double> sizes, counts;
  for (const DensityRow& row : series) {
    if (!row.ok()) continue;
    sizes.push_back(tetrahedra_of(row));
    counts.push_back(work_of(row, work));
  }
  const bool is_graded = series.front().density == "graded";
  std::optional<Fit> fit = fit_of(work.name, sizes, counts, is_graded ? rule_for_steep_work : rule_for_work);
  if (!fit) return;
  if (!work.is_judged) fit->not_judged = "shown beside the others";
  fits.push_back({*std::move(fit), series});
}

std::string finding_of(const DensityFit& fit) {
  const Estimate& exponent = fit.growth.power.slope;
  return fit.series.front().density + " density, " + fit.series.front().locator + ", " + fit.quantity +
         ": the exponent is " + with_interval(exponent) + ": " +
         choose(is_at_most(exponent, 1 + linear_within), "not more than linear", "undecided", "more than linear");
}

void plan_series(const ExperimentOptions& options, const DensitySeries& series, std::vector<DensityRow>& rows) {
  for (const int division : divisions_of(series, options.tetrahedra)) {
    DensityRow& row = rows.emplace_back();
    row.density = series.density, row.locator = series.locator;
    row.edge_length = series.longest / division;
    const std::string name = std::string(series.solid) + "-" + std::to_string(division);
    const auto surface = options.folder / "models" / ("density-" + name + ".poly");
    io::write_plc(models::make_solid(series.solid, row.edge_length), surface);
    row.measured.asked = single_case(options, name + ", " + series.locator, "ccdt", surface,
                                     words_of(series.words + " --face-protection off --improve none --steiner keep"));
    row.measured.asked.verify = false;  // the same tetrahedra are verified in other experiments
  }
}

}  // namespace

ExperimentResult density_result(std::span<const DensityRow> rows) {
  ExperimentResult result{.how = once(), .definitions = density_definitions};
  std::vector<DensityFit> fits;
  for (const MeasuredSeries series : neighbors(rows, [](const DensityRow&a, const DensityRow&b) {
         return a.density == b.density && a.locator == b.locator;
       }))
    for (const FrontWork& work : front_works) add_fit(series, work, fits);
  for (const DensityFit& fit : fits)
    if (fit.is_judged()) result.findings.push_back(finding_of(fit));
  if (result.findings.empty()) result.findings.push_back("no fit is judged: the range of sizes is too short");
  result.tables = {table_of_rows("growth", "Growth of exact counts of the front", density_fit_columns(), fits),
                   table_of_rows("work", "Work per tetrahedron of the front", density_point_columns, rows)};
  for (const DensityRow& row : rows) add_problem_of(row, result);
  return result;
}

ExperimentResult measure_density(const ExperimentOptions& options, bench::Runner& runner) {
  std::vector<DensityRow> rows;
  for (const DensitySeries& series : all_series)
    if (is_chosen(options, series.solid)) plan_series(options, series, rows);
  check_something_is_measured(rows.size(), "density");
  measure_rows(runner, rows);
  return density_result(rows);
}

}  // namespace ccdt::experiments
