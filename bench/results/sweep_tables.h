#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/results/case_summary.h"
#include "bench/results/result_table.h"
#include "bench/results/row_columns.h"

namespace ccdt::results {

/// \name The tables of a sweep. Tables that do not apply have no rows.
/// @{

/// A row for each case: labels, outcome, counts, seconds, memory and quality.
ResultTable cases_table(const Sweep& sweep, std::span<const CaseSummary> cases);

/// A row for each mesher: the numbers of solved cases, and of failures by kind.
ResultTable failures_table(std::span<const CaseSummary> cases);

/// Groups of cases of our mesher whose strategies must give the same mesh, and whether they do.
ResultTable same_mesh_table(const Sweep& sweep, std::span<const CaseSummary> cases);

/// The solved cases with their seconds, for charts.
ResultTable solved_table(const Sweep& sweep, std::span<const CaseSummary> cases);

/// Power laws of seconds over tetrahedra: one fit for each model, mesher and set of options with at least three sizes
/// over a decade; its points, and its line, for charts.
struct ScalingTables {
  ResultTable fits, points, lines;
};
ScalingTables scaling_tables(const Sweep& sweep, std::span<const CaseSummary> cases);

/// Pairs of solved cases of two meshers that agree in the input and in all options that both meshers have; and the
/// diagonals of their charts.
struct PairTables {
  std::string reference;  ///< the mesher with which all others are compared
  ResultTable summary, pairs, diagonals;
};
PairTables pair_tables(const Sweep& sweep, std::span<const CaseSummary> cases);

/// Time and quality of each mesher and set of options, over the inputs of a model (or all files) that all of them
/// solve.
ResultTable pareto_table(const Sweep& sweep, std::span<const CaseSummary> cases);
/// @}

/// The columns that identify a case: input, model, edge length, mesher, options.
RowColumns<CaseSummary> label_columns(const Sweep& sweep);

/// A table without rows that has these columns first.
ResultTable labeled_table(const Sweep& sweep, std::string name, std::string title, std::vector<Column> more,
                          bool is_data = false);

/// Appends a row to such a table.
void add_labeled_row(ResultTable& table, std::vector<std::string> runs, std::vector<Cell> labels,
                     std::vector<Cell> more);

/// The name of an option's column in all tables: "face_protection".
std::string option_column(const std::string& option);

}  // namespace ccdt::results
