#include "tools/experiments.h"

#include <cstdio>
#include <vector>

#include "engine/io/output_file.h"
#include "reports/ablation_report.h"
#include "reports/fig8_report.h"
#include "reports/interior_points_report.h"
#include "reports/lattice_fit_report.h"
#include "reports/lattices_report.h"
#include "reports/locators_report.h"
#include "reports/mesher_quality_report.h"
#include "reports/table1_report.h"
#include "tools/progress_bar.h"

namespace ccdt {
namespace {

void write_text(const std::string& text, const std::filesystem::path& file) {
  io::OutputFile output(file);
  output << text;
  output.commit();
}

/// Measures with a progress bar, then reports.
template <class Result>
Result measure_and_report(const std::string& name, const ExperimentOptions& options,
                          Result (*measure)(const ExperimentOptions&, const Progress&)) {
  Result result = [&] {
    ProgressBar bar;
    return measure(options, bar.progress());
  }();
  write_text(to_json(result), options.folder / (name + ".json"));
  write_text(to_markdown(result), options.folder / (name + ".md"));
  std::fputs(to_terminal(result).c_str(), stdout);
  return result;
}

bool run_table1(const ExperimentOptions& options) {
  const Table1 table = measure_and_report("table1", options, measure_table1);
  for (const Table1Model& model : table.models) {
    if (!model.same_tetrahedra) return false;
    for (const Table1Row& row : model.rows)
      if (row.paper_seconds && row.status != RunStatus::ok) return false;
  }
  return true;
}

bool run_fig8(const ExperimentOptions& options) {
  const Fig8 fig8 = measure_and_report("fig8", options, measure_fig8);
  write_text(to_csv(fig8), options.folder / "fig8.csv");
  for (const Fig8Model& model : fig8.models)
    for (const Fig8Series& series : model.series)
      for (const Fig8Point& point : series.points)
        if (point.status != RunStatus::ok) return false;
  return true;
}

bool run_locators(const ExperimentOptions& options) {
  const Locators locators = measure_and_report("locators", options, measure_locators);
  for (const LocatorsCase& c : locators.cases)
    for (const LocatorsRow& row : c.rows)
      if (row.status != RunStatus::ok) return false;
  return true;
}

bool run_interior_points(const ExperimentOptions& options) {
  const InteriorPoints points = measure_and_report("interior-points", options, measure_interior_points);
  for (const InteriorCase& c : points.cases)
    if (c.status != RunStatus::ok) return false;
  return true;
}

/// Did every surface and every run of our own go well?
bool our_rows_are_ok(const QualityStudy& study, bool (*is_ours)(const QualityRow&)) {
  for (const QualityCase& c : study.cases) {
    if (!c.reason.empty()) return false;
    for (const QualityRow& row : c.rows)
      if (is_ours(row) && !row.ok()) return false;
  }
  return true;
}

bool every_row(const QualityRow& /*row*/) {
  return true;
}

bool run_quality(const ExperimentOptions& options) {
  return our_rows_are_ok(measure_and_report("quality", options, measure_mesher_quality), is_ours);
}

bool run_lattices(const ExperimentOptions& options) {
  return our_rows_are_ok(measure_and_report("lattices", options, measure_lattices), every_row);
}

bool run_ablation(const ExperimentOptions& options) {
  return our_rows_are_ok(measure_and_report("ablation", options, measure_ablation), every_row);
}

bool run_lattice_fit(const ExperimentOptions& options) {
  return our_rows_are_ok(measure_and_report("lattice-fit", options, measure_lattice_fit), every_row);
}

}  // namespace

std::span<const ReproducibleExperiment> reproducible_experiments() {
  static const std::vector<ReproducibleExperiment> all = {
      {"table1", "Delaunay, the CDT with and without the face protection check, and other meshers", "6 minutes",
       run_table1},
      {"fig8", "time against size, from 10^4 to 10^6 vertices, and how it grows", "20 minutes", run_fig8},
      {"locators", "grid, octree and cavity on even and on graded surfaces", "5 minutes", run_locators},
      {"interior-points", "do interior points never harm existence, as the paper says?", "4 minutes",
       run_interior_points},
      {"quality", "our tetrahedra beside those of other meshers, at equal numbers of them", "30 minutes", run_quality},
      {"lattices", "FCC, BCC and SC, before and after improvement", "1 minute", run_lattices},
      {"ablation", "swaps only, smoothing only, both", "1 minute", run_ablation},
      {"lattice-fit", "how near to the surface lattice points should be", "2 minutes", run_lattice_fit},
  };
  return all;
}

}  // namespace ccdt
