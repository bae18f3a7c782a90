#include "reports/result_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bench/results/csv_text.h"
#include "bench/run/json.h"
#include "bench/run/median_interval.h"
#include "bench/run/numbers.h"
#include "engine/base/digits.h"

namespace ccdt::reports {
namespace {

using bench::rounded;
using bench::with_interval;
using bench::with_separators;
using results::Cell;
using results::Column;
using results::ResultRow;

/// The width of a UTF-8 text in columns of a terminal: continuation bytes take none.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::size_t> column_widths(const TextTable& table, std::size_t least) {
  std::vector<std::size_t> widths;
  for (const auto& row : table) {
    widths.resize(std::max(widths.size(), row.size()), least);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  }
  return widths;
}

std::string aligned(const std::string& text, std::size_t column, std::size_t to) {
  const std::string spaces(to - width(text), ' ');
  return column == 0 ? text + spaces : spaces + text;
}

bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// For a cell of a Markdown table, which a bar would end.
std::string in_cell(const std::string& markdown) {
  std::string safe;
  for (const char c : markdown) safe += c == '|' ? "\\|" : std::string(1, c);
  return safe;
}

/// A text with code in backticks, such as those of our own.
std::string markdown_prose(const std::string& text) {
  std::string safe;
  std::size_t at = 0;
  while (true) {
    const std::size_t begin = text.find('`', at);
    const std::size_t end = begin == std::string::npos ? begin : text.find('`', begin + 1);
    if (end == std::string::npos) return safe + markdown_text(text.substr(at));
    safe += markdown_text(text.substr(at, begin - at)) + markdown_code(text.substr(begin + 1, end - begin - 1));
    at = end + 1;
  }
}

/// Whole numbers with separators, others with four digits.
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
  if (const auto* estimate = std::get_if<bench::Estimate>(&cell)) return with_interval(*estimate);
  return "";
}

bool is_empty(const ResultTable& table, std::size_t column) {
  return std::ranges::all_of(table.rows, [&](const ResultRow& row) { return cell_text(row.cells[column]).empty(); });
}

/// With all digits needed to read the same number back.
std::string all_digits(double value) {
  return std::isfinite(value) ? digits(value) : "";
}

bool has_estimates(const ResultTable& table, std::size_t column) {
  return std::ranges::any_of(
      table.rows, [&](const ResultRow& row) { return std::holds_alternative<bench::Estimate>(row.cells[column]); });
}

std::string csv_cell(const Cell& cell, bool as_estimate) {
  if (const auto* e = std::get_if<bench::Estimate>(&cell))
    return all_digits(e->value) + "," + all_digits(e->low) + "," + all_digits(e->high);
  std::string text;
  if (const auto* number = std::get_if<double>(&cell)) text = all_digits(*number);
  if (const auto* words = std::get_if<std::string>(&cell)) text = results::csv_text(*words);
  return as_estimate ? text + ",," : text;
}

/// No character acts as a command. At the beginning of a row, a bracket or an asterisk would be an argument of the end
/// of the row before. Line feeds could make paragraphs, which captions must not have, and other control characters are
/// errors.
std::string latex_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      safe += std::string("\\") + c + "{}";
    else if (std::string("&%$#_{}").find(c) != std::string::npos)
      safe += std::string("\\") + c;
    else if (safe.empty() && (c == '[' || c == '*'))
      safe += std::string("{") + c + "}";
    else if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
      safe += ' ';
    else
      safe += c;
  }
  return safe;
}

/// A title with a line for each text; nothing without texts.
std::string list(const std::string& title, const char* bullet, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& line : lines) text += bullet + line + "\n";
  return text + "\n";
}

std::string markdown_list(const std::string& title, std::vector<std::string> lines) {
  std::ranges::transform(lines, lines.begin(), markdown_prose);
  return list("## " + title + "\n", "- ", lines);
}

std::string machine(const bench::Environment& e) {
  std::string text = e.cpu + ", " + std::to_string(e.cores) + " cores, load " + rounded(e.load_average, 2) + "; " +
                     e.system + "; " + e.compiler + " " + e.flags + "; revision " + e.revision;
  for (const auto& [name, version] : e.libraries) text.append("; ").append(name).append(" ").append(version);
  return text;
}

std::string how_measured(const results::Circumstances& how) {
  if (how.runs <= 1) return "One run of each case; everything but the seconds is the same in every run.";
  const std::string medians =
      "Medians of " + std::to_string(how.runs) + " runs or more, in turns, after one warm-up run";
  if (how.runs < bench::fewest_for_interval) return medians + "; so few runs have no interval.";
  return medians + ", with " + rounded(100 * how.confidence, 2) + "% intervals.";
}

/// Of the remeshed surface and its mesh.
double all_seconds(const bench::RunRecord& r) {
  return r.costs[Stage::remesh].seconds + r.costs.mesh_seconds;
}

std::string stages(const bench::RunRecord& r) {
  constexpr double least_share = 0.01;  // of all; the other stages do not matter to a reader
  std::string text;
  const auto add = [&](std::string name, double seconds) {
    if (seconds < least_share * all_seconds(r) || seconds == 0) return;
    std::ranges::replace(name, '_', ' ');
    text += (text.empty() ? "" : ", ") + name + " " + rounded(seconds, 2);
  };
  for (const auto& stage : names_of(Stage{})) add(std::string(stage.name), r.costs[stage.value].seconds);
  return text.empty() ? "" : " (" + text + ")";
}

/// Nothing if the surface was not refined.
std::string refinement(const MeshCounts& c) {
  if (c.refined_on_segments + c.refined_in_facets == 0) return "";
  return "refinement  " + with_separators(c.refined_on_segments) + " vertices on segments, " +
         with_separators(c.refined_in_facets) + " in facets\n";
}

/// Nothing for other meshers.
std::string segments(const std::optional<SegmentCounts>& s) {
  if (!s) return "";
  std::string text = "segments    " + with_separators(s->all) + ": " + with_separators(s->delaunay) + " Delaunay";
  if (s->split > 0) text += ", " + with_separators(s->split) + " split into " + with_separators(s->pieces) + " pieces";
  if (s->restored > 0) text += " (" + with_separators(s->restored) + " segments restored)";
  if (s->front > 0) text += ", " + with_separators(s->front) + " left to the front";
  return text + "\n";
}

/// Nothing if no edge was split and no point dropped.
std::string protection(const MeshCounts& c) {
  std::string text;
  for (const std::uint64_t splits : c.splits_by_level)
    text += (text.empty() ? "splits by level " : ", ") + with_separators(splits);
  if (c.dropped_interior_vertices > 0)
    text += (text.empty() ? "" : "; ") + with_separators(c.dropped_interior_vertices) +
            " interior points dropped to keep edges";
  return text.empty() ? "" : "protection  " + text + "\n";
}

/// Nothing if no lattice had a core.
std::string lattice_cores(const MeshCounts& c) {
  if (c.core_tetrahedra == 0) return "";
  return "cores       " + with_separators(c.core_tetrahedra) + " tetrahedra deep within the lattice\n";
}

std::string measure_words(const bench::Quality::Measure& m) {
  return "mean " + rounded(m.mean) + ", 99% below " + rounded(m.p99) + ", worst " + rounded(m.max);
}

/// Rounded down where rounding would make it 180 degrees, which no tetrahedron has.
std::string largest_angle(const bench::Quality& quality) {
  const double angle = quality.dihedral_degrees.max;
  return angle >= 179.5 ? rounded(std::floor(100 * angle) / 100, 5) : rounded(angle);
}

std::string quality_lines(const bench::Quality& q) {
  return "quality     r: " + measure_words(q.r) + "; dihedral angles " + rounded(q.dihedral_degrees.min) + " to " +
         largest_angle(q) + " degrees\n            aspect ratio: " + measure_words(q.aspect_ratio) +
         "\n            radius-edge ratio: " + measure_words(q.radius_edge_ratio) + "\n";
}

std::string surface_line(const surface::SurfaceChange& change) {
  const auto& [x, y, z] = change.farthest;
  return "surface     at most " + rounded(change.distance) + " from that of the input (near " + rounded(x, 6) + ", " +
         rounded(y, 6) + ", " + rounded(z, 6) + "); area changed by " + rounded(change.area_change) +
         (change.volume_change ? ", volume by " + rounded(*change.volume_change) : "") + "\n";
}

/// The first rows of a table, and the number of the others.
std::string first_rows(const ResultTable& table, std::size_t most) {
  if (table.rows.size() <= most) return to_terminal(text_table(table));
  ResultTable part = table;
  part.rows.resize(most);
  return to_terminal(text_table(part)) + with_separators(table.rows.size() - most) + " more rows are in tables/\n";
}

std::string check_word(const verify::Check& check) {
  if (!check.not_compared.empty()) return "skipped";
  if (check.failed == 0) return "ok";
  return check.required ? "FAILED" : "differs";
}

/// One line per check, with its first failures below it.
std::string check_lines(const std::vector<verify::Check>& checks) {
  std::size_t width = 0;
  for (const verify::Check& check : checks) width = std::max(width, check.name.size());
  std::string text;
  for (const verify::Check& check : checks) {
    const std::string word = check_word(check);
    text += word + std::string(9 - word.size(), ' ') + check.name + std::string(width + 2 - check.name.size(), ' ');
    if (!check.not_compared.empty())
      text += "not compared: " + check.not_compared;
    else if (check.failed == 0)
      text += with_separators(check.checked);
    else
      text += with_separators(check.failed) + " of " + with_separators(check.checked);
    text += "\n";
    for (const std::string& example : check.examples) text += "           " + example + "\n";
  }
  return text;
}

std::string volumes(const verify::Verification& verification) {
  constexpr int digits = 6;
  std::string text = "volume   " + rounded(verification.mesh_volume, digits) +
                     " (input: " + rounded(verification.input_volume, digits) + ")\n";
  if (const auto& distances = verification.distances)
    text += "distance " + rounded(distances->to_input) + " from the input, " + rounded(distances->from_input) +
            " of the input from the mesh (limit: " + rounded(distances->limit) + ")\n";
  return text;
}

}  // namespace

std::string heading(const Column& column) {
  return column.unit.empty() ? column.title : column.title + " (" + column.unit + ")";
}

std::string to_terminal(const TextTable& table) {
  const auto widths = column_widths(table, 0);
  std::string text;
  for (std::size_t r = 0; r < table.size(); ++r) {
    std::string line, rule;
    for (std::size_t c = 0; c < table[r].size(); ++c) {
      line += (c == 0 ? "" : "  ") + aligned(table[r][c], c, widths[c]);
      rule += (c == 0 ? "" : "  ") + std::string(widths[c], '-');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
    if (r == 0) text += rule + "\n";
  }
  return text;
}

std::string markdown_text(const std::string& text) {
  const auto is_within_word = [&](std::size_t i) {
    const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    return i > 0 && i + 1 < text.size() && is_letter(text[i - 1]) && is_letter(text[i + 1]);
  };
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool acts = std::string_view("\\`*[]~").find(c) != std::string_view::npos ||
                      (c == '_' && !is_within_word(i)) ||
                      (i == 0 && std::string_view("#+->=").find(c) != std::string_view::npos);
    if (acts) safe += '\\';
    safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : is_line_end(c) ? " " : std::string(1, c);
  }
  return safe;
}

std::string markdown_code(const std::string& text) {
  if (text.empty()) return "";
  std::string line = text;
  std::ranges::replace_if(line, is_line_end, ' ');  // an empty line would end the code
  std::size_t longest = 0, run = 0;                 // of backticks
  for (const char c : line) longest = std::max(longest, run = c == '`' ? run + 1 : 0);
  if (longest == 0) return "`" + line + "`";
  const std::string fence(longest + 1, '`');
  return fence + " " + line + " " + fence;
}

std::string to_markdown(const TextTable& table, const std::set<std::size_t>& code_columns) {
  TextTable cells = table;
  for (std::size_t r = 0; r < cells.size(); ++r)
    for (std::size_t c = 0; c < cells[r].size(); ++c)
      cells[r][c] =
          in_cell(r > 0 && code_columns.contains(c) ? markdown_code(cells[r][c]) : markdown_text(cells[r][c]));
  const auto widths = column_widths(cells, 3);
  std::string text;
  for (std::size_t r = 0; r < cells.size(); ++r) {
    cells[r].resize(widths.size());
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c) text += " " + aligned(cells[r][c], c, widths[c]) + " |";
    text += "\n";
    if (r > 0) continue;
    text += "|";
    for (std::size_t c = 0; c < widths.size(); ++c)
      text += c == 0 ? std::string(widths[c] + 2, '-') + "|" : std::string(widths[c] + 1, '-') + ":|";
    text += "\n";
  }
  return text;
}

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
    text += (c == 0 ? "" : ",") + results::csv_text(name);
    for (const char* bound : {"_low", "_high"})
      if (is_estimate[c]) text += "," + results::csv_text(name + bound);
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
    if (!is_empty(table, c)) columns += table.columns[c].kind == results::ColumnKind::label ? "l" : "r";
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

std::string to_terminal(const ExperimentResult& result, std::size_t most_rows) {
  std::string text = result.title + "\n\n";
  for (const ResultTable& table : result.tables)
    if (!table.is_data && !table.rows.empty()) text += table.title + "\n\n" + first_rows(table, most_rows) + "\n";
  return text + list("Findings", "  ", result.findings) + list("Problems", "  ", result.problems) +
         how_measured(result.how) + "\n";
}

std::string to_markdown(const ExperimentResult& result) {
  std::string text = "# " + markdown_text(result.title) + "\n\n" + how_measured(result.how) + "\n\n";
  text += markdown_list("Findings", result.findings) + markdown_list("Problems", result.problems);
  for (const ResultTable& table : result.tables)
    if (!table.is_data && !table.rows.empty())
      text += "## " + markdown_text(table.title) + "\n\n" + to_markdown(text_table(table)) + "\n";
  return text + markdown_list("Definitions", result.definitions) + "## How it was measured\n\n" +
         markdown_code(result.how.command) + "\n\n" + markdown_text(machine(result.how.environment)) + "\n";
}

std::string improvement_line(const ImproveCounts& c) {
  if (c.stop == ImproveStop::none) return "";
  std::string text =
      "improvement " + with_separators(c.bad_cells) + " tetrahedra to improve: " + with_separators(c.removed_edges) +
      " edges and " + with_separators(c.removed_faces) + " faces removed, " + with_separators(c.moved_vertices) +
      " vertices moved, " + with_separators(c.inserted_vertices) + " inserted, " + with_separators(c.collapsed_edges) +
      " collapsed, " + with_separators(c.reconnected_polyhedra) + " polyhedra reconnected; ";
  if (c.stop == ImproveStop::target) return text + "all reach the target\n";
  return text + with_separators(c.bad_cells_left) + " are left, " +
         (c.stop == ImproveStop::time ? "because the time was up" : "because no change improves them") + "\n";
}

std::string summarize(const bench::RunRecord& r) {
  const MeshCounts& c = r.counts;
  std::string text = "vertices    " + with_separators(c.vertices) + " (" + with_separators(c.steiner_vertices) +
                     " Steiner, " + with_separators(c.interior_vertices) + " interior)\n";
  text += refinement(c) + segments(c.segments) + protection(c) + lattice_cores(c);
  text += "tetrahedra  " + with_separators(c.tetrahedra) + ", volume " + rounded(r.quality.volume, 6) + "\n";
  text += "seconds     " + rounded(all_seconds(r)) + stages(r) + ", peak memory " + bench::mebibytes(r.peak_rss_bytes) +
          "\n";
  text += quality_lines(r.quality);
  text += improvement_line(c.improve);
  if (r.surface_change) text += surface_line(*r.surface_change);
  for (const bench::MissedRequirement& missed : r.missed)
    text += "missed      " + words_of(missed, c.tetrahedra) + "\n";
  for (const std::string& note : r.notes) text += "note        " + note + "\n";
  return text;
}

std::string in_one_line(const bench::RunRecord& r) {
  return with_separators(r.counts.tetrahedra) + " tetrahedra in " + rounded(all_seconds(r)) + " s, dihedral angles " +
         rounded(r.quality.dihedral_degrees.min) + " to " + largest_angle(r.quality) + " degrees, worst r " +
         rounded(r.quality.r.max);
}

std::string summarize(const verify::Verification& verification) {
  std::vector<verify::Check> shown;  // not those that passed
  std::size_t required = 0, passed = 0;
  for (const verify::Check& check : verification.checks) {
    if (!check.not_compared.empty()) shown.push_back(check);
    if (!check.required || !check.not_compared.empty()) continue;
    ++required;
    if (check.failed == 0)
      ++passed;
    else
      shown.push_back(check);
  }
  return "checks   " + std::to_string(passed) + " of " + std::to_string(required) + " passed (--details lists them)\n" +
         volumes(verification) + check_lines(shown);
}

std::string to_terminal(const verify::Verification& verification) {
  return check_lines(verification.checks) + volumes(verification);
}

std::string to_json(const verify::Verification& verification, const std::string& input, const std::string& mesh) {
  bench::Json checks = bench::Json::array();
  for (const verify::Check& check : verification.checks) {
    checks.push_back({{"name", check.name},
                      {"checked", check.checked},
                      {"failed", check.failed},
                      {"required", check.required},
                      {"examples", check.examples}});
    if (!check.not_compared.empty()) checks.back()["not_compared"] = check.not_compared;
  }
  bench::Json json = {{"schema", "ccdt.verify/1"},
                      {"input", input},
                      {"mesh", mesh},
                      {"ok", verification.ok()},
                      {"mesh_volume", verification.mesh_volume},
                      {"input_volume", verification.input_volume},
                      {"checks", checks}};
  if (const auto& distances = verification.distances)
    json["distances"] = {
        {"limit", distances->limit}, {"to_input", distances->to_input}, {"from_input", distances->from_input}};
  return bench::to_text(json);
}

}  // namespace ccdt::reports
