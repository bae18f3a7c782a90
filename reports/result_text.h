#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "bench/results/experiment_result.h"
#include "bench/run/run_record.h"
#include "bench/verify/verify.h"

namespace ccdt::reports {

using results::ExperimentResult;
using results::ResultTable;

/// The title of a column, with its unit.
std::string heading(const results::Column& column);

/// A table of texts: the first row is the heading, the first column is aligned left and the others right. Rows may be
/// short.
using TextTable = std::vector<std::vector<std::string>>;

/// For a terminal: columns are aligned by spaces, and a rule follows the heading.
std::string to_terminal(const TextTable& table);

/// In Markdown, with aligned columns so that the source is readable too. The cells of some columns are shown as code.
std::string to_markdown(const TextTable& table, const std::set<std::size_t>& code_columns = {});

/// A text in Markdown that shows the same characters. Files may hold any text, even HTML.
std::string markdown_text(const std::string& text);

/// The same as code.
std::string markdown_code(const std::string& text);

/// A table for people: empty columns are left out, numbers are rounded, estimates have their intervals, and a failed
/// row says why.
TextTable text_table(const ResultTable& table);

/// All columns and rows with all digits, an estimate as three columns (name, name_low, name_high); RFC 4180.
std::string to_csv(const ResultTable& table);

/// A `tabular` with the rules of LaTeX's package booktabs, in a `table` with a caption and a label.
std::string to_latex(const ResultTable& table, const std::string& experiment);

/// An experiment for a terminal or in Markdown. A terminal gets at most `most_rows` rows of each table.
std::string to_terminal(const ExperimentResult& result, std::size_t most_rows = std::string::npos);
std::string to_markdown(const ExperimentResult& result);

/// A run in a few lines: counts, Steiner vertices, seconds per stage and quality.
std::string summarize(const bench::RunRecord& record);

/// How often each change was made, with a line feed; nothing if the mesh was not improved.
std::string improvement_line(const ImproveCounts& counts);

/// A run in one line: what was made, how good it is, and how long it took.
std::string in_one_line(const bench::RunRecord& record);

/// The result of `ccdt verify` in two lines: how many tetrahedra and checks, and the volumes. Failed checks follow,
/// each with its first examples, and those for which the mesh has no data.
std::string summarize(const verify::Verification& verification);

/// All checks of `ccdt verify`: one line per check, with the first failures below it, and the volumes.
std::string to_terminal(const verify::Verification& verification);

/// As JSON of schema `ccdt.verify/1`.
std::string to_json(const verify::Verification& verification, const std::string& input, const std::string& mesh);

}  // namespace ccdt::reports
