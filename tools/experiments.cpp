#include "tools/experiments.h"

#include <cstdio>
#include <vector>

#include "engine/io/output_file.h"
#include "reports/fig8_report.h"
#include "reports/interior_points_report.h"
#include "reports/locators_report.h"
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

}  // namespace

std::span<const ReproducibleExperiment> reproducible_experiments() {
  static const std::vector<ReproducibleExperiment> all = {
      {"table1", "Delaunay, the CDT with and without the face protection check, and other meshers", "6 minutes",
       run_table1},
      {"fig8", "time against size, from 10^4 to 10^6 vertices, and how it grows", "20 minutes", run_fig8},
      {"locators", "grid, octree and cavity on even and on graded surfaces", "5 minutes", run_locators},
      {"interior-points", "do interior points never harm existence, as the paper says?", "4 minutes",
       run_interior_points},
  };
  return all;
}

}  // namespace ccdt
