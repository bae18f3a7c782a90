#pragma once

#include <string>
#include <vector>

#include "bench/results/experiment_result.h"

namespace ccdt::reports {

/// A table of texts: the first row is the heading, the first column is aligned left and the others right. Rows may be
/// short.
using TextTable = std::vector<std::vector<std::string>>;

/// With columns aligned by spaces, for a terminal. A rule follows the heading.
std::string to_terminal(const TextTable& table);

/// In Markdown, with aligned columns so that the source can be read as well.
std::string to_markdown(const TextTable& table);

/// A table as people read it: columns that are empty in all rows are left out, numbers are rounded, estimates have
/// their intervals, and a row that failed says why.
TextTable text_table(const results::ResultTable& table);

/// All columns and rows with all digits, an estimate as three columns (name, name_low, name_high); RFC 4180.
std::string to_csv(const results::ResultTable& table);

/// A `tabular` with the rules of LaTeX's package booktabs, in a `table` with a caption and a label.
std::string to_latex(const results::ResultTable& table, const std::string& experiment);

/// What a reader at a terminal gets of an experiment, or one of Markdown.
std::string to_terminal(const results::ExperimentResult& result);
std::string to_markdown(const results::ExperimentResult& result);

}  // namespace ccdt::reports
