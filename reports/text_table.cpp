#include "reports/text_table.h"

#include <algorithm>

namespace ccdt {
namespace {

/// How many columns of a terminal a UTF-8 text takes: continuation bytes take none.
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

/// A text within a Markdown cell, where a bar would end the cell and a line feed the row.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
  return safe;
}

}  // namespace

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

std::string to_markdown(const TextTable& table) {
  TextTable cells = table;
  for (auto& row : cells)
    for (auto& cell : row) cell = escaped(cell);
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

}  // namespace ccdt
