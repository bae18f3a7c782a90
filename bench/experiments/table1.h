#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/measured_case.h"

namespace ccdt::experiments {

/// One row of one model: what was timed. The seconds are none if the case failed.
struct Table1Row : CaseOutcome {
  std::string id;     ///< delaunay, with_check, without_check, ccdt_mesh, cgal_delaunay, tetgen_cdt, ...
  std::string label;  ///< for people
  std::optional<double> paper_seconds = {};
};

struct Table1Ratio {
  std::string id, label;
  std::optional<bench::Estimate> value = {};
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
  std::vector<Table1Row> rows;
  std::vector<Table1Ratio> ratios;
  std::optional<Table1Costs> costs;  ///< none if a run of ours failed
  bool same_tetrahedra = true;       ///< with and without the check: the same set, as it must be
};

/// Table 1 of the paper, measured here.
struct Table1 {
  results::Circumstances how;
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
results::ExperimentResult result_of(const Table1& table);

}  // namespace ccdt::experiments
