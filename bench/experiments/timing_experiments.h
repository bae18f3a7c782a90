#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "bench/experiments/measured_case.h"
#include "bench/statistics.h"
#include "engine/base/enum_names.h"

namespace ccdt::experiments {

/// One row of one model: what was timed. The seconds are none if the case failed.
struct Table1Row : CaseOutcome {
  std::string id;     ///< delaunay, with_check, without_check, ccdt_mesh, cgal_delaunay, tetgen_cdt, ...
  std::string label;  ///< for people
  std::optional<double> paper_seconds = {};
};

struct Table1Ratio {
  std::string id, label;
  std::optional<Estimate> value = {};
  std::optional<double> paper = {};
  std::vector<std::string> runs = {};  ///< files of all runs that it is made of
};

/// What a unit of work costs, in microseconds; medians.
struct Table1Costs {
  double delaunay_per_vertex = 0;
  double check_per_vertex = 0;       ///< face check, front and labeling of the run with the check
  double front_per_tetrahedron = 0;  ///< of the run without the check, whose front builds every tetrahedron
};

struct Table1Model {
  std::string name;
  double edge_length = 0;  ///< units of the model
  std::vector<Table1Row> rows = {};
  std::vector<Table1Ratio> ratios = {};
  std::optional<Table1Costs> costs = {};  ///< none if a run of ours failed
  bool same_tetrahedra = true;            ///< with and without the check: the same set, as it must be
};

/// Table 1 of the paper, measured here.
struct Table1 {
  Circumstances how;
  std::vector<Table1Model> models;
};

/// Measures all rows on the paper's three models. Every run is a process of its own; the cases of a model take turns
/// (A B C A B C ...). A case that fails in its first run has a row with the reason and is not run again.
///
/// \throw OutputError  a file of the experiment cannot be written
Table1 measure_table1(const ExperimentOptions& options, const Progress& progress = {});

/// The paper lets every face go through the front at more than this many times the cost of Delaunay; so should we.
inline constexpr double least_gain = 8;

/// As tables, with what they say.
ExperimentResult result_of(const Table1& table);

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
  Circumstances how;
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
ExperimentResult result_of(const Fig8& fig8);

/// One locator on one surface. Seconds are of the front.
struct LocatorsRow : CaseOutcome {
  LocatorKind locator = LocatorKind::grid;
};

enum class SurfaceKind {
  uniform,  ///< one of the paper's models
  graded,   ///< edges of very different length
  rough,    ///< some of its faces are not Delaunay
  input     ///< a file of the user's
};

constexpr auto names_of(SurfaceKind) {
  return std::to_array<NamedValue<SurfaceKind>>({{SurfaceKind::uniform, "uniform"},
                                                 {SurfaceKind::graded, "graded"},
                                                 {SurfaceKind::rough, "rough"},
                                                 {SurfaceKind::input, "input"}});
}

/// A surface, meshed with each of the locators.
struct LocatorsCase {
  std::string name;
  SurfaceKind kind = SurfaceKind::uniform;
  bool face_protection = false;
  double edge_ratio = 1;  ///< the longest edge of the surface over the shortest
  MeshCounts counts = {};
  std::vector<LocatorsRow> rows = {};  ///< grid, octree, cavity
  std::optional<Estimate> octree_over_grid = {}, cavity_over_grid = {};
};

/// How fast the locators find the front's candidates.
struct Locators {
  Circumstances how;
  std::vector<LocatorsCase> cases;
};

/// What is expected of octree and grid on such a surface: on a graded one the octree is faster, on a uniform one the
/// grid. None for the others, and where a run failed.
std::optional<BoundTest> expectation(const LocatorsCase& locators);

/// Measures the front of the three locators: without the check on the paper's models at uniform density and on a graded
/// cube, with and without it on a rough sphere and on the files of the user.
///
/// \throw InputError   a file cannot be read
/// \throw OutputError  a file of the experiment cannot be written
Locators measure_locators(const ExperimentOptions& options, const Progress& progress = {});

/// As tables, with what they say.
ExperimentResult result_of(const Locators& locators);

/// The Delaunay tetrahedralization of the same points by insertion, wrapping (paper, section 5), CGAL and TetGen, over
/// sizes. The Google Benchmark program `bench_delaunay` measures; its JSON is kept as it writes it, as
/// benchmarks/bench_delaunay.json, and the tables come from it alone:
///
///   times   points, size, method, status | vertices, tetrahedra | seconds, microseconds_per_vertex | reason
///   ratios  points, size | vertices | insert_over_cgal, wrap_over_insert, tetgen_over_insert
///
/// Points are uniformly random, a face-centred lattice, vertices of meshes of the models (if none is asked for, of the
/// piston) and of `options.inputs`. A number that two methods must have alike and have not is a problem. Without the
/// program the result has no rows, and a problem that says how to get it.
///
/// \throw OutputError  the folder cannot be written
/// \throw InputError   there is nothing to measure
ExperimentResult measure_delaunay(const ExperimentOptions& options, const Progress& progress = {});

/// Where `bench_delaunay` is, beside `ccdt` or in its build tree; empty if it is not there.
std::filesystem::path find_bench_delaunay(const std::filesystem::path& ccdt);

/// The command that measures, as an experiment with these options does.
std::vector<std::string> bench_delaunay_command(const std::filesystem::path& program, const ExperimentOptions& options,
                                                const std::filesystem::path& output);

/// Makes tables, findings and problems of the JSON that Google Benchmark wrote.
/// \throw InputError  it is no such JSON
void evaluate_delaunay(const std::string& benchmark_json, ExperimentResult& result);

}  // namespace ccdt::experiments
