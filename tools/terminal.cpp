#include "tools/terminal.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

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

}  // namespace

std::string toned(const std::string& text, Tone tone) {
  return has_colors() ? code_of(tone) + text + "\033[0m" : text;
}

}  // namespace ccdt::tools
