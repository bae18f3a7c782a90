#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "baselines/process.h"
#include "bench/results/result_table.h"
#include "bench/run/environment.h"
#include "bench/run/json.h"

namespace ccdt::results {

/// The circumstances of an experiment; part of its result.
struct Circumstances {
  bench::Environment environment;
  int runs = 0;  ///< counted runs per case, after one warm-up run
  double confidence = 0.95;
  baselines::Limits limits;  ///< of each run
  double tetrahedra = 0;     ///< approximate number of tetrahedra per model
  std::string scale;         ///< as on the command line: "quick", "full", "large", or a number
  std::string command;       ///< that repeats the experiment
};

/// A mesh that is kept for pictures and the viewer.
struct KeptMesh {
  std::string file;        ///< of schema `ccdt.mesh/1`, relative to the folder
  std::string title;       ///< for people
  std::string run;         ///< the file of the run that made it
  bool is_figure = false;  ///< drawn as a separate picture, cut open
};

/// The result of an experiment, written as JSON of schema `ccdt.experiment/1`. Reports are made from it alone.
struct ExperimentResult {
  std::string name = {};     ///< as on the command line
  std::string title = {};    ///< for people
  std::string section = {};  ///< of the paper: "6, Fig. 8"
  Circumstances how = {};
  std::vector<std::string> definitions = {};  ///< what the rows mean, one sentence each
  std::vector<ResultTable> tables = {};
  std::vector<std::string> findings = {};  ///< findings from the tables, one sentence each; computed
  std::vector<std::string> problems = {};  ///< problems, one sentence each
  std::vector<KeptMesh> meshes = {};
  std::vector<std::string> raw_files = {};  ///< JSON of other programs, kept as they wrote it; relative to the folder
  bool is_good = true;  ///< ccdt did not fail and gave no wrong result; failures of other meshers are only rows
};

/// Null if there is no such table.
const ResultTable* find_table(const ExperimentResult& result, std::string_view name);

/// Parts that other documents share.
bench::Json cell_json(const Cell& cell);
void to_json(bench::Json& json, const ResultTable& table);
void from_json(const bench::Json& json, ResultTable& table);
void to_json(bench::Json& json, const KeptMesh& mesh);
void from_json(const bench::Json& json, KeptMesh& mesh);

/// As JSON of schema `ccdt.experiment/1`, indented. Numbers that are not finite become null.
std::string to_json(const ExperimentResult& result);
/// \throw InputError  it is not JSON of that schema
ExperimentResult experiment_result_from_json(const std::string& text);

/// Writes FOLDER/NAME.json, whole or not at all. \throw OutputError
void write_experiment_result(const ExperimentResult& result, const std::filesystem::path& folder);
/// \throw InputError  it cannot be read, or is not JSON of that schema
ExperimentResult read_experiment_result(const std::filesystem::path& file);

}  // namespace ccdt::results
