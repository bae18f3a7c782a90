#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/results/experiment_result.h"
#include "bench/results/row_columns.h"
#include "bench/run/runner.h"
#include "bench/run/statistics.h"
#include "engine/mesh/tet_mesh.h"

/// Tables of measured cases: rows that stand for cases, and the columns that many such tables have.
namespace ccdt::results {

using bench::Case, bench::Estimate, bench::MeasuredCase, bench::Runner, bench::RunRecord, bench::SecondsOf;

/// \name Seconds of a run.
/// @{
/// The seconds of the constrained Delaunay tetrahedralization of given vertices, as in the paper: Delaunay, face check,
/// front and labeling.
double cdt_seconds(const StageCosts& costs);
double whole_seconds(const StageCosts& costs);
SecondsOf stage_seconds(Stage stage);
/// @}

/// A row of a table: a case, and which of its seconds are meant. Rows with more contents derive from it.
struct CaseRow {
  MeasuredCase measured = {};
  SecondsOf seconds = whole_seconds;

  bool ok() const { return !measured.failed(); }
};

/// The files of the runs behind a row.
std::vector<std::string> runs_of(const CaseRow& row);

/// The seconds of the counted runs, and their median; none if a run failed.
std::vector<double> samples_of(const CaseRow& row);
std::optional<Estimate> seconds_of(const CaseRow& row);

/// The median of the ratios to the runs of another row in the same rounds; none if one of them failed or took no time.
std::optional<Estimate> ratio_of(const CaseRow& above, const CaseRow& below);

/// Does the row belong to our mesher?
bool is_ours(const CaseRow& row);

/// The name of its mesher, whether built in or described by a file.
std::string mesher_of(const CaseRow& row);

/// \name Columns of such rows. Figures and seconds are empty if a run failed.
/// @{
RowColumn<CaseRow> status_column();
RowColumn<CaseRow> reason_column();
RowColumn<CaseRow> seconds_column();
RowColumn<CaseRow> count_column(std::string name, std::uint64_t MeshCounts::*count, std::string title = {});
/// A figure of the first run.
RowColumn<CaseRow> run_column(Column column, const std::function<Cell(const RunRecord&)>& figure);
/// @}

/// Why a run failed: "timeout: limit of 600 s".
std::string failure(const MeasuredCase& measured);

/// The kept mesh of the case.
/// \pre it has not failed, and has a `mesh_ending`
mesh::TetMesh mesh_of(const Runner& runner, const MeasuredCase& measured);

/// Also keeps this mesh for pictures and the viewer, in meshes/ID.json.
/// \throw OutputError
KeptMesh keep_mesh(const Runner& runner, const MeasuredCase& measured, const std::string& title);

/// Runs the cases of the rows (`measured.asked`), and fills in the measurements.
/// \param rows  derived from `CaseRow`
template <class Rows>
void measure_rows(Runner& runner, Rows& rows) {
  std::vector<Case> asked;
  for (const CaseRow& row : rows) asked.push_back(row.measured.asked);
  std::vector<MeasuredCase> measured = runner.run(asked);
  for (std::size_t i = 0; i < measured.size(); ++i) rows[i].measured = std::move(measured[i]);
}

/// The files of the runs of these rows, row by row, without duplicates.
template <class Rows>
std::vector<std::string> all_runs_of(const Rows& rows) {
  std::vector<std::string> files;
  for (const CaseRow& row : rows)
    for (std::string& file : runs_of(row))
      if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
  return files;
}

}  // namespace ccdt::results
