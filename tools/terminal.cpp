#include "tools/terminal.h"

#include <unistd.h>

#include <boost/locale/utf.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "engine/base/errors.h"

namespace ccdt::tools {
namespace {

bool has_colors() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool refuses = no_color != nullptr && *no_color != '\0';
  return !refuses && terminal != nullptr && std::string_view(terminal) != "dumb" && isatty(STDOUT_FILENO) == 1;
}

const char* code_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "\033[32m";
    case Tone::bad:
      return "\033[1;31m";
    case Tone::note:
      break;
  }
  return "\033[33m";
}

using Utf8 = boost::locale::utf::utf_traits<char>;

/// Does the character act on a terminal instead of being shown: by moving the cursor, or by turning the direction of
/// the text around it?
bool is_control(std::uint32_t code) {
  if (code == '\n' || code == '\t') return false;
  const auto is_from = [&](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code < 0x20 || is_from(0x7F, 0x9F) || code == 0x61C || is_from(0x200E, 0x200F) || is_from(0x2028, 0x202E) ||
         is_from(0x2066, 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    auto next = text.begin();
    const auto code = Utf8::decode(next, text.end());
    const bool is_valid = code != boost::locale::utf::illegal && code != boost::locale::utf::incomplete;
    const std::size_t length = is_valid ? static_cast<std::size_t>(next - text.begin()) : 1;
    if (is_valid && !is_control(code)) {
      safe += text.substr(0, length);
    } else {
      char digits[8];
      std::snprintf(digits, sizeof digits, is_valid ? "\\u%04x" : "\\x%02x",
                    is_valid ? unsigned{code} : unsigned{static_cast<unsigned char>(text[0])});
      safe += digits;
    }
    text.remove_prefix(length);
  }
  return safe;
}

void print(std::string_view text) {
  std::fputs(printable(text).c_str(), stdout);
}

void print(std::string_view text, Tone tone) {
  if (!has_colors()) return print(text);
  std::fputs((code_of(tone) + printable(text) + "\033[0m").c_str(), stdout);
}

void print_error_line(std::string_view text) {
  std::fputs((printable(text) + "\n").c_str(), stderr);
}

void flush_output() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw OutputError("cannot be written: " + std::generic_category().message(errno), {.file = "standard output"},
                      "check the disk, or the file or program to which it goes");
}

}  // namespace ccdt::tools
