#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/cases/runner.h"
#include "bench/experiments/experiment.h"
#include "engine/mesh/tet_mesh.h"

/// An experiment is a set of cases, rows that stand for them, tables of these with columns, and what they say. Here is
/// what these parts have in common. `cases::Runner` runs the cases.
namespace ccdt::experiments {

/// \name Seconds of a run.
/// @{
/// Of the constrained Delaunay tetrahedralization of given vertices, the paper's CDT times: Delaunay, face check, front
/// and labeling.
double cdt_seconds(const StageSeconds& seconds);
double whole_seconds(const StageSeconds& seconds);
/// @}

/// A case that is run once: one whose figures are of interest, but not its times. Its mesh is verified.
///
/// \param name  for people and problems: "piston, insert"
cases::Case single_case(const ExperimentOptions& options, std::string name, std::string mesher,
                        const std::filesystem::path& input, std::vector<std::string> words);

/// How narrow the interval of a median is to be on either side, over the median, where nobody asks for more.
inline constexpr double usual_precision = 0.05;

/// The same, run until some of its seconds are known as precisely as that.
///
/// \param group  of the cases that it takes turns with
cases::Case timed_case(const ExperimentOptions& options, std::string group, const cases::Case& single,
                       double until = usual_precision, cases::SecondsOf seconds = whole_seconds);

/// A definition: how often timed cases are run.
std::string repetition_words(const ExperimentOptions& options, double until = usual_precision);

/// Circumstances that say only that there is one run a case; the others are the same for all experiments.
inline Circumstances once() {
  Circumstances how;
  how.runs = 1;
  return how;
}

/// A row of a table: a case, and which of its seconds are meant. Experiments derive their rows from it.
struct CaseRow {
  cases::MeasuredCase measured = {};
  cases::SecondsOf seconds = whole_seconds;

  bool ok() const { return !measured.failed(); }
};

/// The files of the runs that a row stands on.
std::vector<std::string> runs_of(const CaseRow& row);

/// The seconds of the counted runs, and their median; none if a run failed.
std::vector<double> samples_of(const CaseRow& row);
std::optional<Estimate> seconds_of(const CaseRow& row);

/// Over that of another row; none if one of them failed or took no time.
std::optional<Estimate> ratio_of(const CaseRow& above, const CaseRow& below);

/// Is it of our own mesher?
bool is_ours(const CaseRow& row);

/// The name of its mesher, whether built in or described by a file.
std::string mesher_of(const CaseRow& row);

/// \name Columns of such rows. Figures and seconds are empty where a run failed.
/// @{
RowColumn<CaseRow> status_column();
RowColumn<CaseRow> reason_column();
RowColumn<CaseRow> seconds_column();
RowColumn<CaseRow> count_column(std::string name, std::uint64_t MeshCounts::*count, std::string title = {});
/// A figure of the first run.
RowColumn<CaseRow> run_column(Column column, const std::function<Cell(const RunRecord&)>& figure);
/// @}

/// Why a run failed: "timeout: limit of 600 s".
std::string failure(const cases::MeasuredCase& measured);

/// Makes the failure of a row a problem. Of our own mesher it is one that makes the result bad.
void add_problem_of(const CaseRow& row, ExperimentResult& result);

/// The mesh that the case has kept.
/// \pre it has not failed, and has a `mesh_ending`
mesh::TetMesh mesh_of(const cases::Runner& runner, const cases::MeasuredCase& measured);

/// Keeps that mesh for pictures and the viewer, too, in meshes/ID.json.
/// \throw OutputError
KeptMesh keep_mesh(const cases::Runner& runner, const cases::MeasuredCase& measured, const std::string& title);

/// Runs the cases that rows ask for (in `measured.asked`), and fills in what was measured.
/// \param rows  derived from `CaseRow`
template <class Rows>
void measure_rows(cases::Runner& runner, Rows& rows) {
  std::vector<cases::Case> asked;
  for (const CaseRow& row : rows) asked.push_back(row.measured.asked);
  std::vector<cases::MeasuredCase> measured = runner.run(asked);
  for (std::size_t i = 0; i < measured.size(); ++i) rows[i].measured = std::move(measured[i]);
}

/// Neighbors that belong together.
template <class Row, class Same>
std::vector<std::span<const Row>> neighbors(std::span<const Row> rows, Same belong_together) {
  std::vector<std::span<const Row>> groups;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && belong_together(rows[begin], rows[end])) ++end;
    groups.push_back(rows.subspan(begin, end - begin));
  }
  return groups;
}

/// The files of these rows' runs, one row's after the other's, none twice.
template <class Rows>
std::vector<std::string> all_runs_of(const Rows& rows) {
  std::vector<std::string> files;
  for (const CaseRow& row : rows)
    for (std::string& file : runs_of(row))
      if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
  return files;
}

}  // namespace ccdt::experiments
