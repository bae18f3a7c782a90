#include "tools/terminal.h"

#include <unistd.h>

#include <array>
#include <bit>
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

/// A character in UTF-8.
struct Character {
  std::uint32_t code = 0;
  std::size_t length = 1;  ///< in bytes
  bool is_valid = false;
};

/// The first character of a text. A byte that begins none is one that is not valid.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto ones = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (ones == 0) return {byte(0), 1, true};
  if (ones == 1 || ones > 4 || text.size() < ones) return {byte(0)};
  Character character{byte(0) & (0x7Fu >> ones), ones, true};
  for (std::size_t i = 1; i < ones; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {byte(0)};
    character.code = character.code << 6 | (byte(i) & 0x3F);
  }
  static constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};  // else it is too long
  return character.code >= least[ones] ? character : Character{byte(0)};
}

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
    const Character character = first_character(text);
    if (character.is_valid && !is_control(character.code)) {
      safe += text.substr(0, character.length);
    } else {
      char digits[8];
      std::snprintf(digits, sizeof digits, character.is_valid ? "\\u%04x" : "\\x%02x", character.code);
      safe += digits;
    }
    text.remove_prefix(character.length);
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
