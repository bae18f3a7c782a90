#include "reports/result_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "bench/results/numbers.h"

namespace ccdt {
namespace {

/// A whole number with separators, another with four digits.
std::string number_text(double value) {
  constexpr double largest = 1e15;
  if (!std::isfinite(value)) return std::isnan(value) ? "" : "infinite";
  if (value == std::floor(value) && std::abs(value) < largest)
    return (value < 0 ? "-" : "") + with_separators(static_cast<std::uint64_t>(std::abs(value)));
  return rounded(value, 4);
}

std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return number_text(*number);
  if (const auto* estimate = std::get_if<Estimate>(&cell)) return with_interval(*estimate);
  return "";
}

std::string heading(const Column& column) {
  return column.unit.empty() ? column.title : column.title + " (" + column.unit + ")";
}

bool is_empty(const ResultTable& table, std::size_t column) {
  for (const ResultRow& row : table.rows)
    if (!cell_text(row.cells[column]).empty()) return false;
  return true;
}

/// With all digits that are needed to read the same number back.
std::string all_digits(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

bool has_estimates(const ResultTable& table, std::size_t column) {
  for (const ResultRow& row : table.rows)
    if (std::holds_alternative<Estimate>(row.cells[column])) return true;
  return false;
}

std::string csv_cell(const Cell& cell, bool as_estimate) {
  if (const auto* e = std::get_if<Estimate>(&cell))
    return all_digits(e->value) + "," + all_digits(e->low) + "," + all_digits(e->high);
  std::string text;
  if (const auto* number = std::get_if<double>(&cell)) text = all_digits(*number);
  if (const auto* words = std::get_if<std::string>(&cell)) text = quoted(*words);
  return as_estimate ? text + ",," : text;
}

std::string latex_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      safe += std::string("\\") + c + "{}";
    else if (std::string("&%$#_{}").find(c) != std::string::npos)
      safe += std::string("\\") + c;
    else
      safe += c;
  }
  return safe;
}

std::string bullets(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = "## " + title + "\n\n";
  for (const std::string& line : lines) text += "- " + line + "\n";
  return text + "\n";
}

std::string indented(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text + "\n";
}

std::string machine(const Environment& e) {
  std::string text = e.cpu + ", " + std::to_string(e.cores) + " cores, load " + rounded(e.load_average, 2) + "; " +
                     e.system + "; " + e.compiler + " " + e.flags + "; revision " + e.revision;
  for (const auto& [name, version] : e.libraries) text.append("; ").append(name).append(" ").append(version);
  return text;
}

std::string how_measured(const Circumstances& how) {
  if (how.runs <= 1) return "One run of each; all but the seconds is the same in every run.";
  return "Medians of " + std::to_string(how.runs) + " runs in turn after one that is not counted, with " +
         rounded(100 * how.confidence, 2) + "% intervals.";
}

}  // namespace

TextTable text_table(const ResultTable& table) {
  TextTable text(table.rows.size() + 1);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (is_empty(table, c)) continue;
    text[0].push_back(heading(table.columns[c]));
    for (std::size_t r = 0; r < table.rows.size(); ++r) text[r + 1].push_back(cell_text(table.rows[r].cells[c]));
  }
  return text;
}

std::string to_csv(const ResultTable& table) {
  std::vector<bool> is_estimate;
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& name = table.columns[c].name;
    is_estimate.push_back(has_estimates(table, c));
    text += (c == 0 ? "" : ",") + name;
    if (is_estimate[c]) text.append(",").append(name).append("_low,").append(name).append("_high");
  }
  text += "\r\n";
  for (const ResultRow& row : table.rows) {
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      text += (c == 0 ? "" : ",") + csv_cell(row.cells[c], is_estimate[c]);
    text += "\r\n";
  }
  return text;
}

std::string to_latex(const ResultTable& table, const std::string& experiment) {
  const TextTable cells = text_table(table);
  std::string columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    if (!is_empty(table, c)) columns += table.columns[c].kind == ColumnKind::label ? "l" : "r";
  std::string text = "% \\usepackage{booktabs}\n\\begin{table}\n  \\centering\n  \\caption{" + latex_text(table.title) +
                     "}\n  \\label{tab:" + experiment + "-" + table.name + "}\n  \\begin{tabular}{" + columns +
                     "}\n    \\toprule\n";
  for (std::size_t r = 0; r < cells.size(); ++r) {
    text += "    ";
    for (std::size_t c = 0; c < cells[r].size(); ++c) text += (c == 0 ? "" : " & ") + latex_text(cells[r][c]);
    text += r == 0 ? " \\\\\n    \\midrule\n" : " \\\\\n";
  }
  return text + "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

std::string to_terminal(const ExperimentResult& result) {
  std::string text = result.title + "\n\n";
  for (const ResultTable& table : result.tables)
    if (!table.is_data && !table.rows.empty()) text += table.title + "\n\n" + to_terminal(text_table(table)) + "\n";
  return text + indented("What this says", result.findings) + indented("What went wrong", result.problems) +
         how_measured(result.how) + "\n";
}

std::string to_markdown(const ExperimentResult& result) {
  std::string text = "# " + result.title + "\n\n" + how_measured(result.how) + "\n\n";
  text += bullets("What this says", result.findings) + bullets("What went wrong", result.problems);
  for (const ResultTable& table : result.tables)
    if (!table.is_data && !table.rows.empty())
      text += "## " + table.title + "\n\n" + to_markdown(text_table(table)) + "\n";
  return text + bullets("What the rows mean", result.definitions) + "## How it was measured\n\n`" + result.how.command +
         "`\n\n" + machine(result.how.environment) + "\n";
}

}  // namespace ccdt
