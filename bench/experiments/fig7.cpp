#include "bench/experiments/fig7.h"

#include <algorithm>

#include "bench/experiments/measured_case.h"
#include "bench/experiments/quality_study.h"
#include "bench/experiments/surfaces.h"
#include "bench/results/result_table.h"

namespace ccdt {
namespace {

ResultTable empty_table() {
  return {"meshes",
          "The meshes",
          {{"model", "model", ColumnKind::label},
           {"status", "status", ColumnKind::label},
           {"edge_length", "edge length", ColumnKind::figure, "mm"},
           {"vertices", "vertices"},
           {"tetrahedra", "tetrahedra"},
           {"mean_r", "mean r"},
           {"worst_r", "worst r"},
           {"smallest_dihedral", "smallest dihedral", ColumnKind::figure, "degrees"},
           {"largest_dihedral", "largest dihedral", ColumnKind::figure, "degrees"},
           {"reason", "reason", ColumnKind::note}}};
}

ResultRow row_of(const MeasuredCase& measured, double edge_length) {
  const RunRecord& run = measured.first;
  const Quality& q = run.quality;
  return {{cell_of(measured.name), cell_of(name_of(run.status)), edge_length, cell_of(run.counts.vertices),
           cell_of(run.counts.tetrahedra), q.r.mean, q.r.max, q.dihedral_degrees.min, q.dihedral_degrees.max,
           cell_of(run.reason)},
          run_files(measured)};
}

}  // namespace

ExperimentResult measure_fig7(const ExperimentOptions& options, const Progress& progress) {
  ExperimentOptions small = options;
  small.tetrahedra = std::min(options.tetrahedra, static_cast<double>(most_kept_tetrahedra) / 2);
  ExperimentResult result{.how = start_experiment(small),
                          .definitions = {"All strategies are the default ones; the run has them.",
                                          "In the pictures, tetrahedra in front of a plane through the middle are "
                                          "left out whole."},
                          .tables = {empty_table()}};
  result.how.runs = 1;
  const auto is_asked = [&](const PaperModel& model) { return is_asked_for(options, model.name); };
  check_something_is_measured(static_cast<std::size_t>(std::ranges::count_if(paper_models, is_asked)), "fig7");
  for (std::size_t i = 0; i < paper_models.size(); ++i) {
    if (!is_asked(paper_models[i])) continue;
    report(progress, paper_models[i].name, i, paper_models.size());
    const SurfaceFile surface = write_solid(small, "fig7", paper_models[i].name, paper_models[i].edge_length);
    const std::string stem = "fig7-" + surface.name;
    MeasuredCase measured{surface.name, stem, {"ccdt", surface.file, options.folder / "meshes" / "fig7.vtu", {}}};
    run_once(small, measured, 0);
    result.tables[0].rows.push_back(row_of(measured, surface.edge_length));
    if (measured.failed()) {
      result.problems.push_back(surface.name + ": " + measured.first.reason);
      result.is_good = false;
      continue;
    }
    result.meshes.push_back(keep_mesh(small, measured, surface.name));
    result.meshes.back().is_figure = true;
  }
  std::filesystem::remove(options.folder / "meshes" / "fig7.vtu");
  return result;
}

}  // namespace ccdt
