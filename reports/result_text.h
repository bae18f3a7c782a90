#pragma once

#include <string>
#include <vector>

#include "bench/results/experiment_result.h"
#include "bench/run_record.h"
#include "bench/verify/verify.h"

namespace ccdt::reports {

using results::ExperimentResult;
using results::ResultTable;

/// A table of texts: the first row is the heading, the first column is aligned left and the others right. Rows may be
/// short.
using TextTable = std::vector<std::vector<std::string>>;

/// With columns aligned by spaces, for a terminal. A rule follows the heading.
std::string to_terminal(const TextTable& table);

/// In Markdown, with aligned columns so that the source can be read as well.
std::string to_markdown(const TextTable& table);

/// A table as people read it: columns that are empty in all rows are left out, numbers are rounded, estimates have
/// their intervals, and a row that failed says why.
TextTable text_table(const ResultTable& table);

/// All columns and rows with all digits, an estimate as three columns (name, name_low, name_high); RFC 4180.
std::string to_csv(const ResultTable& table);

/// A `tabular` with the rules of LaTeX's package booktabs, in a `table` with a caption and a label.
std::string to_latex(const ResultTable& table, const std::string& experiment);

/// What a reader at a terminal gets of an experiment, or one of Markdown. A terminal gets so many rows of each table.
std::string to_terminal(const ExperimentResult& result, std::size_t most_rows = std::string::npos);
std::string to_markdown(const ExperimentResult& result);

/// What a person wants to know after a mesh: counts, Steiner vertices, seconds by stage and the worst quality; a few
/// lines.
std::string summarize(const bench::RunRecord& record);

/// The result of `ccdt verify`: one line a check, with the first failures under it, and the volumes.
std::string to_terminal(const verify::Verification& verification);

/// As JSON of schema `ccdt.verify/1`.
std::string to_json(const verify::Verification& verification, const std::string& input, const std::string& mesh);

}  // namespace ccdt::reports
