#pragma once

#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"
#include "bench/statistics.h"

namespace ccdt::experiments {

/// The exponent that we claim for the growth of the time with the number of vertices; 1 is linear.
inline constexpr double claimed_exponent = 1.10;

/// One size of one model, meshed with one strategy. Seconds are of the CDT; of other meshers, of all.
struct Fig8Point : CaseOutcome {
  double edge_length = 0;                 ///< units of the model
  std::vector<StageSeconds> stages = {};  ///< of the counted runs, in order
};

/// How the seconds of a stage grow with the number of vertices: medians over the points that went well.
struct Fig8Fit {
  std::string quantity;  ///< cdt, delaunay, front; mesh: all that another mesher does
  std::size_t points = 0;
  double least_vertices = 0, most_vertices = 0;
  bench::LineFit line;   ///< seconds over vertices
  bench::LineFit power;  ///< logarithms of both
};

struct Fig8Series {
  std::string id, label, mesher;  ///< id: insert, wrap, without_check, or that of the mesher
  std::vector<Fig8Point> points = {};
  std::vector<Fig8Fit> fits = {};  ///< none with fewer than three points
};

struct Fig8Model {
  std::string name;
  std::vector<Fig8Series> series;
};

/// Fig. 8 of the paper, measured here: time against size at uniform density.
struct Fig8 {
  results::Circumstances how;
  std::vector<Fig8Model> models;
};

/// Measures the paper's models in eight sizes over two decades, from a tenth of the wanted number of tetrahedra to ten
/// times as many; what is slow, at the coarser of these only. The strategies take turns at each size. Sizes that a
/// model cannot have are left out.
///
/// \throw OutputError  a file of the experiment cannot be written
Fig8 measure_fig8(const ExperimentOptions& options, const Progress& progress = {});

/// Fits to the points of a series.
std::vector<Fig8Fit> fit_series(const Fig8Series& series);

/// As tables, with what they say.
results::ExperimentResult result_of(const Fig8& fig8);

}  // namespace ccdt::experiments
