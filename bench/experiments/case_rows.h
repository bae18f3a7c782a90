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

/// A case that is run once: one whose figures are of interest, but not its times. Its mesh is verified.
///
/// \param name  for people and problems: "piston, insert"
cases::Case single_case(const ExperimentOptions& options, std::string name, std::string mesher,
                        const std::filesystem::path& input, std::vector<std::string> words);

/// The same, run until its time is known well: once for warming up, then `options.runs` times, and on until the
/// interval of the median is at most this share of it wide on either side.
///
/// \param group  of the cases that it takes turns with
cases::Case timed_case(const ExperimentOptions& options, std::string group, const cases::Case& single, double until);

/// A row of a table: a case, and which of its seconds are meant. Experiments derive their rows from it.
struct CaseRow {
  cases::MeasuredCase measured = {};
  cases::SecondsOf seconds = &StageSeconds::mesh;

  bool ok() const { return !measured.failed(); }
};

/// The files of the runs that a row stands on.
std::vector<std::string> runs_of(const CaseRow& row);

/// The seconds of the counted runs, and their median; none if a run failed.
std::vector<double> samples_of(const CaseRow& row);
std::optional<Estimate> seconds_of(const CaseRow& row);

/// Over that of another row; none if one of them failed or took no time.
std::optional<Estimate> ratio_of(const CaseRow& above, const CaseRow& below);

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
