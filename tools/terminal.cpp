#include "tools/terminal.h"

#include <unistd.h>

#include <cerrno>
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

/// The length in bytes of a control character of Unicode's first or second set, other than a line feed or tab, at the
/// start of a text; 0: there is none.
std::size_t control_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 32 || byte(0) == 127) return byte(0) == '\n' || byte(0) == '\t' ? 0 : 1;
  return byte(0) == 0xC2 && text.size() > 1 && (byte(1) & 0xE0) == 0x80 ? 2 : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const std::size_t control = control_length(text);
    if (control == 0) {
      safe += text[0];
      text.remove_prefix(1);
      continue;
    }
    char digits[8];  // the last byte is the code point
    std::snprintf(digits, sizeof digits, "\\u%04x", unsigned{static_cast<unsigned char>(text[control - 1])});
    safe += digits;
    text.remove_prefix(control);
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
