#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/regression.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// The exponent that we claim for the growth of the time with the number of vertices; 1 is linear.
inline constexpr double claimed_exponent = 1.10;

/// Cases whose CDT takes longer than this in their first run are counted at most three times.
inline constexpr double long_run_seconds = 30;
inline constexpr int counted_long_runs = 3;

/// One size of one model, meshed with one strategy.
struct Fig8Point {
  double edge_length = 0;  ///< units of the model
  MeshCounts counts;
  std::vector<StageSeconds> samples;  ///< of the counted runs, in order
  std::optional<Estimate> cdt;        ///< none if a run failed
  RunStatus status = RunStatus::ok;
  std::string reason;
};

/// How the seconds of a stage grow with the number of vertices: medians over the points that went well.
struct Fig8Fit {
  std::string id;  ///< cdt, delaunay, front
  LineFit line;    ///< seconds over vertices
  LineFit power;   ///< logarithms of both
};

struct Fig8Series {
  std::string id, label;  ///< insert, wrap, without_check
  std::vector<Fig8Point> points;
  std::vector<Fig8Fit> fits;  ///< none with fewer than three points
};

struct Fig8Model {
  std::string name;
  std::vector<Fig8Series> series;
};

/// Fig. 8 of the paper, measured here: time against size at uniform density.
struct Fig8 {
  Circumstances how;
  std::vector<Fig8Model> models;
};

/// Measures the paper's models in sizes that about double, from 10^4 vertices to 10^6 (with the check) and to more than
/// 10^5 (Delaunay by `wrap`, and without the check). The strategies take turns at each size. Sizes that `scale` makes
/// too coarse for a model are left out.
///
/// \throw OutputError  a file of the experiment cannot be written
Fig8 measure_fig8(const ExperimentOptions& options, const Progress& progress = {});

/// Fits to the points of a series; `with_front` as well to the front alone.
std::vector<Fig8Fit> fit_series(const Fig8Series& series, bool with_front);

/// As JSON of schema `ccdt.fig8/1`.
std::string to_json(const Fig8& fig8);
/// One row a counted run, with a heading.
std::string to_csv(const Fig8& fig8);

/// What the rows mean, one sentence each.
std::vector<std::string> fig8_definitions();

}  // namespace ccdt
