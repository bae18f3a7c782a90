#include <algorithm>

#include "bench/experiments/quality_experiments.h"
#include "bench/experiments/registry.h"

namespace ccdt::experiments {
namespace {

ResultTable meshes_table() {
  return table_of("meshes", "The meshes",
                  {label_column("model"), label_column("status"), figure_column("edge_length", "", "mm"),
                   figure_column("vertices"), figure_column("tetrahedra"), figure_column("mean_r"),
                   figure_column("worst_r"), figure_column("smallest_dihedral", "", "degrees"),
                   figure_column("largest_dihedral", "", "degrees"), note_column("reason")});
}

void measure_model(const ExperimentOptions& options, const PaperModel& model, ExperimentResult& result) {
  const SurfaceFile surface = write_solid(options, "fig7", model.name, model.edge_length);
  const std::string stem = "fig7-" + surface.name;
  MeasuredCase measured{surface.name, stem, {"ccdt", surface.file, options.folder / "meshes" / "fig7.vtu", {}}};
  run_once(options, measured, 0);
  const RunRecord& run = measured.first;
  const bench::Quality& q = run.quality;
  add_row(result.tables[0], run_files(measured), surface.name, name_of(run.status), surface.edge_length,
          run.counts.vertices, run.counts.tetrahedra, q.r.mean, q.r.max, q.dihedral_degrees.min, q.dihedral_degrees.max,
          run.reason);
  if (measured.failed()) return add_problem(result, surface.name + ": " + run.reason);
  result.meshes.push_back(keep_mesh(options, measured, surface.name));
  result.meshes.back().is_figure = true;
}

}  // namespace

ExperimentResult measure_fig7(const ExperimentOptions& options, const Progress& progress) {
  ExperimentOptions small = options;
  small.tetrahedra = std::min(options.tetrahedra, static_cast<double>(most_kept_tetrahedra) / 2);
  ExperimentResult result{.how = start_experiment(small, 1),
                          .definitions = {"All strategies are the default ones; the run has them.",
                                          "In the pictures, tetrahedra in front of a plane through the middle are "
                                          "left out whole."},
                          .tables = {meshes_table()}};
  const auto is_asked = [&](const PaperModel& model) { return is_asked_for(options, model.name); };
  check_something_is_measured(static_cast<std::size_t>(std::ranges::count_if(paper_models, is_asked)), "fig7");
  for (std::size_t i = 0; i < paper_models.size(); ++i) {
    if (!is_asked(paper_models[i])) continue;
    report(progress, paper_models[i].name, i, paper_models.size());
    measure_model(small, paper_models[i], result);
  }
  std::filesystem::remove(options.folder / "meshes" / "fig7.vtu");
  return result;
}

}  // namespace ccdt::experiments
