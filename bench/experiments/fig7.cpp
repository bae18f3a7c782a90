#include <algorithm>
#include <functional>

#include "bench/experiments/experiment.h"
#include "bench/experiments/quality_experiments.h"
#include "bench/experiments/timing_experiments.h"

namespace ccdt::experiments {
namespace {

struct Row : CaseRow {
  SurfaceFile surface;
};

RowColumn<Row> quality_column(const char* name, const std::function<double(const bench::Quality&)>& measure,
                              const char* unit = "") {
  return run_column(figure_column(name, "", unit), [measure](const RunRecord& run) { return measure(run.quality); });
}

const RowColumns<Row> fig7_columns = {
    {label_column("model"), [](const Row& row) { return row.surface.name; }},
    status_column(),
    {figure_column("edge_length", "", "mm"), [](const Row& row) { return row.surface.edge_length; }},
    count_column("vertices", &MeshCounts::vertices),
    count_column("tetrahedra", &MeshCounts::tetrahedra),
    quality_column("mean_r", [](const auto& q) { return q.r.mean; }),
    quality_column("worst_r", [](const auto& q) { return q.r.max; }),
    quality_column(
        "smallest_dihedral", [](const auto& q) { return q.dihedral_degrees.min; }, "degrees"),
    quality_column(
        "largest_dihedral", [](const auto& q) { return q.dihedral_degrees.max; }, "degrees"),
    reason_column()};

}  // namespace

ExperimentResult measure_fig7(const ExperimentOptions& options, bench::Runner& runner) {
  ExperimentOptions small = options;
  small.tetrahedra = std::min(options.tetrahedra, static_cast<double>(most_kept_tetrahedra) / 2);
  ExperimentResult result{
      .how = start_experiment(small, 1),
      .definitions = {"All strategies are the defaults; the record of the run lists them.",
                      "In the pictures, all tetrahedra in front of a plane through the middle are left out."}};
  std::vector<Row> rows;
  for (const PaperModel& model : paper_models) {
    if (!is_chosen(options, model.name)) continue;
    const SurfaceFile surface = write_solid(small, "fig7", model.name, model.edge_length);
    bench::Case asked = single_case(options, model.name, "ccdt", surface.file, {});
    asked.mesh_ending = ".vtu";
    rows.push_back({{{asked}}, surface});
  }
  check_something_is_measured(rows.size(), "fig7");
  measure_rows(runner, rows);
  for (const Row& row : rows) {
    add_problem_of(row, result);
    if (!row.ok()) continue;
    result.meshes.push_back(keep_mesh(runner, row.measured, row.surface.name));
    result.meshes.back().is_figure = true;
  }
  result.tables = {table_of_rows("meshes", "The meshes", fig7_columns, rows)};
  return result;
}

}  // namespace ccdt::experiments
