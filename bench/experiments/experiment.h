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
#include "bench/results/case_rows.h"
#include "bench/results/experiment_result.h"
#include "bench/results/result_table.h"
#include "bench/results/row_columns.h"
#include "bench/results/row_views.h"
#include "bench/run/median_interval.h"
#include "bench/run/numbers.h"
#include "bench/run/run_record.h"
#include "bench/run/runner.h"
#include "bench/run/statistics.h"
#include "engine/base/progress.h"

namespace ccdt::experiments {

using bench::BoundTest, bench::Estimate, bench::is_at_least, bench::is_at_most, bench::joined, bench::rounded,
    bench::RunRecord, bench::with_interval, bench::with_separators;
using results::add_row, results::all_runs_of, results::as_cell, results::CaseRow, results::cdt_seconds, results::Cell,
    results::cell_if, results::cells, results::Circumstances, results::column, results::Column, results::ColumnKind,
    results::count_column, results::ExperimentResult, results::failure, results::figure_column, results::keep_mesh,
    results::KeptMesh, results::label_column, results::measure_rows, results::mesh_of, results::neighbors,
    results::note_column, results::reason_column, results::ResultRow, results::ResultTable, results::RowColumn,
    results::RowColumns, results::rows_with, results::RowView, results::RowViews, results::run_column,
    results::seconds_column, results::stage_seconds, results::status_column, results::table_of, results::table_of_rows,
    results::time_column, results::whole_seconds;

/// The options of every experiment of `ccdt reproduce`.
struct ExperimentOptions {
  std::filesystem::path program;                   ///< the `ccdt` that is run
  std::filesystem::path folder;                    ///< models, meshes and records go here; exists
  int runs = bench::fewest_for_interval;           ///< counted runs per timed case, after one warm-up run
  double tetrahedra = 100000;                      ///< approximate number of tetrahedra per model
  std::string scale = "full";                      ///< as the user said it
  std::string command = {};                        ///< the command that repeats the experiment
  std::vector<std::string> models;                 ///< models to measure; empty: all of the experiment
  std::optional<std::vector<std::string>> beside;  ///< other meshers to measure; none: all of this build
  std::vector<std::filesystem::path> inputs;  ///< files in the folder to measure as well, if the experiment takes files
  std::filesystem::path corpus = {};          ///< a folder that tools/corpus made, if the experiment takes one
  baselines::Limits limits{.seconds = 600, .memory_bytes = 0};  ///< of each run
};

/// Makes the folders of an experiment: models, meshes, runs.
///
/// \param runs  counted runs per case
/// \return      the circumstances before the first run
Circumstances start_experiment(const ExperimentOptions& options, int runs);

/// The factor by which to multiply an edge length that makes about 100,000 tetrahedra, to get the wanted number.
double edge_factor(const ExperimentOptions& options);

/// Did the user choose this model?
bool is_chosen(const ExperimentOptions& options, std::string_view model);

/// Does this build have the mesher, and did the user not exclude it? Ours always takes part.
bool is_measured(const ExperimentOptions& options, std::string_view mesher);

/// The same for comparisons of times. Mesh_3 cannot mesh our models of the paper's parts with fewer than 50,000
/// tetrahedra, for any edge length, so it takes part only if at least that many are wanted.
bool is_timed(const ExperimentOptions& options, std::string_view mesher);

/// The files in which the user described meshers.
std::vector<std::string> described_meshers(const ExperimentOptions& options);

/// \throw InputError  there is nothing to measure, because none of the chosen models is part of it
void check_something_is_measured(std::size_t cases, std::string_view experiment);

/// The text for the outcome of a test.
std::string choose(BoundTest test, std::string_view holds, std::string_view undecided, std::string_view fails);

/// A case that is run once, because its figures matter but not its times. Its mesh is verified.
///
/// \param name  for people and problems: "piston, insert"
bench::Case single_case(const ExperimentOptions& options, std::string name, std::string mesher,
                        const std::filesystem::path& input, std::vector<std::string> words);

/// The default half-width of a median's interval, as a share of the median.
inline constexpr double usual_precision = 0.05;

/// The same case, repeated until some of its seconds are known with this precision.
///
/// \param group  the cases with which it takes turns
bench::Case timed_case(const ExperimentOptions& options, std::string group, const bench::Case& single,
                       double until = usual_precision, bench::SecondsOf seconds = whole_seconds);

/// Can a case be timed within the budget, by the seconds of its first run? A failed one cannot.
bool is_short(const ExperimentOptions& options, const bench::MeasuredCase& first);

/// The rule of `is_short` in words, for the definitions of an experiment.
std::string short_case_words(const ExperimentOptions& options);

/// How often timed cases are run, in words, for the definitions of an experiment.
std::string repetition_words(const ExperimentOptions& options, double until = usual_precision);

/// Circumstances with one run per case. The other circumstances are the same for all experiments.
inline Circumstances once() {
  Circumstances how;
  how.runs = 1;
  return how;
}

/// Adds a problem. A result is bad if ccdt itself failed.
void add_problem(ExperimentResult& result, std::string problem, bool is_ours = true);

/// Adds the failure of a row as a problem. A failure of our mesher makes the result bad.
void add_problem_of(const CaseRow& row, ExperimentResult& result);

/// The words of a command line, separated by spaces.
std::vector<std::string> words_of(const std::string& line);

/// "20 of 1,000"
std::string share_words(std::uint64_t part, std::uint64_t whole);

template <class Item, class Items>
void append(std::vector<Item>& to, const Items& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace ccdt::experiments
