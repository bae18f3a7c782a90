#pragma once

#include <string>

#include "bench/results/experiment_result.h"
#include "reports/text_table.h"

namespace ccdt {

/// A table as people read it: columns that are empty in all rows are left out, numbers are rounded, estimates have
/// their intervals, and a row that failed says why.
TextTable text_table(const ResultTable& table);

/// All columns and rows with all digits, an estimate as three columns (name, name_low, name_high); RFC 4180.
std::string to_csv(const ResultTable& table);

/// A `tabular` with the rules of LaTeX's package booktabs, in a `table` with a caption and a label.
std::string to_latex(const ResultTable& table, const std::string& experiment);

/// What a reader at a terminal gets of an experiment, or one of Markdown.
std::string to_terminal(const ExperimentResult& result);
std::string to_markdown(const ExperimentResult& result);

}  // namespace ccdt
