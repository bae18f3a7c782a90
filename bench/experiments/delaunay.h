#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

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
results::ExperimentResult measure_delaunay(const ExperimentOptions& options, const Progress& progress = {});

/// Where `bench_delaunay` is, beside `ccdt` or in its build tree; empty if it is not there.
std::filesystem::path find_bench_delaunay(const std::filesystem::path& ccdt);

/// The command that measures, as an experiment with these options does.
std::vector<std::string> bench_delaunay_command(const std::filesystem::path& program, const ExperimentOptions& options,
                                                const std::filesystem::path& output);

/// Makes tables, findings and problems of the JSON that Google Benchmark wrote.
/// \throw InputError  it is no such JSON
void evaluate_delaunay(const std::string& benchmark_json, results::ExperimentResult& result);

}  // namespace ccdt::experiments
