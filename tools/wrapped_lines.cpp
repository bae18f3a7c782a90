#include "tools/wrapped_lines.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <vector>

namespace ccdt::tools {
namespace {

constexpr int usual_columns = 80;
constexpr const char* gap = "  ";

/// Where the words after each gap begin, and those after the indentation.
std::vector<std::size_t> columns_of(std::string_view line) {
  std::vector<std::size_t> begins;
  for (std::size_t i = line.find_first_not_of(' '); i != std::string_view::npos;) {
    begins.push_back(i);
    const std::size_t next = line.find(gap, i);
    i = next == std::string_view::npos ? next : line.find_first_not_of(' ', next);
  }
  return begins;
}

std::string wrapped_line(std::string_view line, std::size_t columns, std::size_t begin) {
  const std::vector<std::size_t> begins = columns_of(line);
  if (begin + line.size() <= columns || begins.size() > 2 || line.starts_with("  ccdt ")) return std::string(line);
  const std::string indent(begins.back(), ' '),
      hanging = indent + (line.starts_with("  -") && indent == gap ? gap : "");
  std::string text(line.substr(0, indent.size()));
  std::size_t length = begin + indent.size();
  bool is_first = true;
  for (std::string_view rest = line.substr(indent.size()); !rest.empty();) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(rest.size(), word.size() + 1));
    if (!is_first && length + 1 + word.size() > columns) {
      text += "\n" + hanging;
      length = hanging.size();
      is_first = true;
    }
    text += (is_first ? "" : " ") + std::string(word);
    length += word.size() + (is_first ? 0 : 1);
    is_first = false;
  }
  return text;
}

}  // namespace

int terminal_columns(int descriptor) {
  int columns = 0;
  if (const char* const given = std::getenv("COLUMNS")) std::from_chars(given, given + std::strlen(given), columns);
  winsize size{};
  if (columns <= 0 && ioctl(descriptor, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
  return columns > 0 ? columns : usual_columns;
}

std::string wrapped(std::string_view text, int columns, std::size_t begin) {
  std::string all;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    all += wrapped_line(line, static_cast<std::size_t>(columns), begin);
    if (line.size() < text.size()) all += '\n';
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    begin = 0;
  }
  return all;
}

}  // namespace ccdt::tools
