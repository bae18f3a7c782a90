#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"
#include "engine/base/enum_names.h"

namespace ccdt::experiments {

/// The measurements of a model for the paper's Table 1: with_check, without_check, default_with_check, searched, ...
struct Table1Model {
  std::string name;
  double edge_length = 0;  ///< units of the model
  std::map<std::string, bench::MeasuredCase> cases = {};
};

/// In the paper, sending every face through the front costs more than this many times as much as Delaunay.
inline constexpr double least_gain = 8;

/// Measures the CDT on our models of the paper's three parts with and without the check, and other meshers for
/// comparison.
ExperimentResult measure_table1(const ExperimentOptions& options, bench::Runner& runner);
ExperimentResult table1_result(std::span<const Table1Model> models);

/// Fig. 7 of the paper: the meshes of our models of its three parts, kept for pictures that show them cut open. They
/// have the wanted number of tetrahedra, but not more than a picture can show.
ExperimentResult measure_fig7(const ExperimentOptions& options, bench::Runner& runner);

/// A model at one size, meshed with one strategy.
struct Fig8Row : CaseRow {
  std::string model, strategy;
  double edge_length = 0;  ///< units of the model
};

/// Measures work and time against size at uniform density (paper, Fig. 8). If the scale allows, the sizes of our models
/// cover two decades, and those of one model three, in steps of a quarter decade. All sizes and strategies run in one
/// random order.
ExperimentResult measure_fig8(const ExperimentOptions& options, bench::Runner& runner);

/// \param rows  grouped by model and strategy, from the coarsest size
ExperimentResult fig8_result(std::span<const Fig8Row> rows);

enum class SurfaceKind {
  uniform,  ///< one of our models of the paper's parts
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

/// A surface, meshed with one of the locators.
struct LocatorsRow : CaseRow {
  std::string name;
  SurfaceKind kind = SurfaceKind::uniform;
  bool face_protection = false;
  double edge_ratio = 1;  ///< the longest edge of the surface over the shortest
  LocatorKind locator = LocatorKind::grid;
};

/// Measures the front with the three locators: without the check on our models at uniform density and on a
/// graded cube; with and without it on a rough sphere and on the user's files.
///
/// \throw InputError  a file cannot be read
ExperimentResult measure_locators(const ExperimentOptions& options, bench::Runner& runner);

/// \param rows  grouped by surface and check: grid, octree, cavity
ExperimentResult locators_result(std::span<const LocatorsRow> rows);

/// The Delaunay tetrahedralization of the same points by insertion, wrapping (paper, section 5), CGAL and TetGen, over
/// sizes. The Google Benchmark program `bench_delaunay` measures; its JSON is kept as it writes it, as
/// benchmarks/bench_delaunay.json, and the tables come from it alone:
///
///   times   points, size, method, status | vertices, tetrahedra | seconds, microseconds_per_vertex | reason
///   ratios  points, size | vertices | insert_over_cgal, wrap_over_insert, tetgen_over_insert
///
/// Points are uniformly random, a face-centered lattice, vertices of meshes of the models (if none is asked for, of the
/// piston) and of `options.inputs`. If two methods differ in a number that must be equal, that is a problem. Without
/// the program, the result has no rows, and a problem that says how to get it.
///
/// \throw OutputError  the folder cannot be written
/// \throw InputError   there is nothing to measure
ExperimentResult measure_delaunay(const ExperimentOptions& options, bench::Runner& runner);

/// The path of `bench_delaunay`, beside `ccdt` or in its build tree; empty if it is missing.
std::filesystem::path find_bench_delaunay(const std::filesystem::path& ccdt);

/// The command that measures, as an experiment with these options does.
std::vector<std::string> bench_delaunay_command(const std::filesystem::path& program, const ExperimentOptions& options,
                                                const std::filesystem::path& output);

/// Makes tables, findings and problems from the JSON that Google Benchmark wrote.
/// \throw InputError  it is not such JSON
void evaluate_delaunay(const std::string& benchmark_json, ExperimentResult& result);

}  // namespace ccdt::experiments
