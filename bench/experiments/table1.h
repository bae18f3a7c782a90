#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/child_process.h"
#include "bench/environment.h"
#include "bench/statistics.h"
#include "engine/base/progress.h"
#include "engine/mesher.h"

namespace ccdt {

/// One row of one model: what was timed, the samples and what came of them.
struct Table1Row {
  std::string id;                   ///< delaunay, with_check, without_check, ccdt_mesh, cgal_delaunay, tetgen_cdt, ...
  std::string label;                ///< for people
  std::vector<double> samples;      ///< seconds of the counted runs, in order
  std::optional<Estimate> seconds;  ///< none if the case failed
  std::optional<double> paper_seconds;
  MeshCounts counts;
  RunStatus status = RunStatus::ok;
  std::string reason;
};

struct Table1Ratio {
  std::string id, label;
  std::optional<Estimate> value;
  std::optional<double> paper;
};

struct Table1Model {
  std::string name;
  double edge_length = 0;  ///< units of the model
  std::vector<Table1Row> rows;
  std::vector<Table1Ratio> ratios;
  bool same_tetrahedra = true;  ///< with and without the check: the same set, as it must be
};

/// Table 1 of the paper, measured here.
struct Table1 {
  Environment environment;
  int runs = 0;
  Limits limits;
  std::vector<Table1Model> models;
};

struct Table1Options {
  std::filesystem::path program;                     ///< the `ccdt` that is run
  std::filesystem::path folder;                      ///< models, meshes and records go here; exists
  int runs = 5;                                      ///< counted runs a case; one more before them is not counted
  double scale = 1;                                  ///< factor of the models' edge lengths
  std::optional<std::vector<std::string>> beside;    ///< other meshers to measure; none: all of this build
  Limits limits{.seconds = 120, .memory_bytes = 0};  ///< of each run
};

/// Measures all rows on the paper's three models. Every run is a process of its own; the cases of a model take turns
/// (A B C A B C ...). A case that fails in its first run has a row with the reason and is not run again.
///
/// \throw OutputError  a file of the experiment cannot be written
Table1 measure_table1(const Table1Options& options, const Progress& progress = {});

/// As JSON of schema `ccdt.table1/1`.
std::string to_json(const Table1& table);

/// What the rows mean, one sentence each; part of every form of the table.
std::vector<std::string> table1_definitions();

}  // namespace ccdt
