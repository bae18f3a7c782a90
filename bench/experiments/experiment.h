#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "baselines/process.h"
#include "bench/results/experiment_result.h"
#include "bench/results/numbers.h"
#include "bench/results/result_table.h"
#include "bench/results/row_columns.h"
#include "bench/results/row_views.h"
#include "bench/run_record.h"
#include "bench/statistics.h"
#include "engine/base/progress.h"

namespace ccdt::experiments {

using bench::Estimate;
using bench::RunRecord;
using results::as_cell;
using results::Cell;
using results::Circumstances;
using results::Column;
using results::column;
using results::ColumnKind;
using results::ExperimentResult;
using results::figure_column;
using results::joined;
using results::KeptMesh;
using results::label_column;
using results::note_column;
using results::ResultRow;
using results::ResultTable;
using results::rounded;
using results::RowColumn;
using results::RowColumns;
using results::rows_with;
using results::RowView;
using results::RowViews;
using results::table_of_rows;
using results::time_column;
using results::with_interval;
using results::with_separators;

/// The options of every experiment of `ccdt reproduce`.
struct ExperimentOptions {
  std::filesystem::path program;                   ///< the `ccdt` that is run
  std::filesystem::path folder;                    ///< models, meshes and records go here; exists
  int runs = 5;                                    ///< counted runs a case; one more before them is not counted
  double tetrahedra = 100000;                      ///< about how many a model is to get
  std::string scale = "paper";                     ///< as the user said it
  std::string command = {};                        ///< that repeats the experiment
  std::vector<std::string> models;                 ///< to measure; empty: all that the experiment has
  std::optional<std::vector<std::string>> beside;  ///< other meshers to measure; none: all of this build
  std::vector<std::filesystem::path> inputs;       ///< files in the folder to measure as well, if it takes files
  baselines::Limits limits{.seconds = 600, .memory_bytes = 0};  ///< of each run
};

/// Makes the folders of an experiment: models, meshes, runs.
///
/// \param runs  counted runs a case
/// \return      the circumstances, as they are before the first run
Circumstances start_experiment(const ExperimentOptions& options, int runs);

/// The factor of an edge length that makes about 100,000 tetrahedra, to make as many as are wanted.
double edge_factor(const ExperimentOptions& options);

/// Has the user asked for this model?
bool is_asked_for(const ExperimentOptions& options, std::string_view model);

/// Does this build have the mesher, and has the user not left it out? Ours always takes part.
bool is_measured(const ExperimentOptions& options, std::string_view mesher);

/// The same where times are compared. Mesh_3 cannot mesh the paper's models with fewer tetrahedra than 50,000, however
/// long its edges may be, so it takes part only where that many are wanted.
bool is_timed(const ExperimentOptions& options, std::string_view mesher);

/// The meshers that the user has described by files, each the path of the file.
std::vector<std::string> described_meshers(const ExperimentOptions& options);

/// \throw InputError  there is nothing to measure, because none of the models that were asked for is part of it
void check_something_is_measured(std::size_t cases, std::string_view experiment);

/// Reports the steps of an experiment, of which the total is known.
class StepCounter {
 public:
  StepCounter(const Progress& progress, std::uint64_t total) : progress_(progress), total_(total) {}
  void next(std::string_view what) { report(progress_, what, done_ < total_ ? done_++ : total_, total_); }

 private:
  const Progress& progress_;
  std::uint64_t total_, done_ = 0;
};

/// The result of comparing an interval with a bound.
enum class BoundTest {
  holds,      ///< all of the interval is on the right side
  undecided,  ///< the bound is inside
  fails       ///< all of the interval is on the wrong side
};
BoundTest is_at_most(const Estimate& estimate, double bound);
BoundTest is_at_least(const Estimate& estimate, double bound);

/// The text for the outcome of a test.
std::string choose(BoundTest test, std::string_view holds, std::string_view undecided, std::string_view fails);

/// Adds what went wrong. A result is bad if anything of our own did.
void add_problem(ExperimentResult& result, std::string problem, bool is_ours = true);

/// The words of a command line, which spaces separate.
std::vector<std::string> words_of(const std::string& line);

/// A command as one types it in a shell.
std::string command_line(const std::vector<std::string>& command);

/// "20 of 1,000"
std::string share_words(std::uint64_t part, std::uint64_t whole);

/// A table that has no rows yet.
inline ResultTable table_of(std::string name, std::string title, std::vector<Column> columns, bool is_data = false) {
  return {std::move(name), std::move(title), std::move(columns), {}, is_data};
}

template <class Items>
void append(std::vector<typename Items::value_type>& to, const Items& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// The value, if it is known; else an empty cell.
template <class Value>
Cell cell_if(bool is_known, const Value& value) {
  return is_known ? as_cell(value) : Cell();
}

/// Cells of any values: texts, numbers, estimates, yes or no, and those that may be missing.
template <class... Values>
std::vector<Cell> cells(const Values&... values) {
  return {as_cell(values)...};
}

/// Appends a row with a cell for each value.
///
/// \param runs  the files of the runs that the row stands on
template <class... Values>
void add_row(ResultTable& table, const std::vector<std::string>& runs, const Values&... values) {
  table.rows.push_back({cells(values...), runs});
}

}  // namespace ccdt::experiments
