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
#include "tools/wrapped_lines.h"

namespace ccdt::tools {
namespace {

Words words = Words::to_output;
std::string kept;        // for a failure
std::size_t column = 0;  // of the next word

std::FILE* stream_of_words() {
  return words == Words::to_output ? stdout : stderr;
}

bool is_terminal(std::FILE* stream) {
  return isatty(fileno(stream)) == 1;
}

[[noreturn]] void fail_to_print() {
  throw OutputError("cannot be written: " + std::generic_category().message(errno), {.file = "standard output"},
                    "check the disk, or the file or program to which it goes");
}

bool has_colors() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool refuses = no_color != nullptr && *no_color != '\0';
  return !refuses && terminal != nullptr && std::string_view(terminal) != "dumb" && is_terminal(stream_of_words());
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

void send_words(Words where) {
  words = where;
}

bool is_quiet() {
  return words == Words::on_failure;
}

void print(std::string_view text) {
  std::string safe = printable(text);
  if (is_quiet()) {
    kept += safe;
    return;
  }
  std::FILE* const stream = stream_of_words();
  if (is_terminal(stream)) safe = wrapped(safe, terminal_columns(fileno(stream)), column);
  column = safe.rfind('\n') == std::string::npos ? column + safe.size() : safe.size() - safe.rfind('\n') - 1;
  std::fputs(safe.c_str(), stream);
}

void print(std::string_view text, Tone tone) {
  const bool colored = has_colors() && !is_quiet();
  if (colored) std::fputs(code_of(tone), stream_of_words());
  print(text);
  if (colored) std::fputs("\033[0m", stream_of_words());
}

void print_data(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail_to_print();
}

void print_help(const std::string& help) {
  print_data(wrapped(printable(help), terminal_columns(STDOUT_FILENO)));
}

void print_error_line(std::string_view text) {
  const std::string line = printable(text) + "\n";
  std::fputs(is_terminal(stderr) ? wrapped(line, terminal_columns(STDERR_FILENO)).c_str() : line.c_str(), stderr);
}

void finish_output(bool failed) {
  if (failed) std::fputs(kept.c_str(), stderr);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail_to_print();
}

}  // namespace ccdt::tools
