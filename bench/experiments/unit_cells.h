#pragma once

#include <string>
#include <vector>

#include "bench/experiments/experiment.h"

namespace ccdt::experiments {

/// The Delaunay tetrahedra of one period of each of the 14 Bravais lattices, with its best free parameters: one row per
/// lattice. Always the same.
ResultTable unit_cells_table();

/// Compares FCC with the best of the other lattices by each criterion, beginning with the mean and the worst r.
/// \param unit_cells  as `unit_cells_table` makes it
ResultTable unit_cell_criteria_table(const ResultTable& unit_cells);

/// States by which criteria FCC is the best lattice, and which lattice is the best by the other criteria.
std::vector<std::string> unit_cell_findings(const ResultTable& table);

/// What the two tables mean, and the rule of the verdict.
std::vector<std::string> unit_cell_definitions();

}  // namespace ccdt::experiments
