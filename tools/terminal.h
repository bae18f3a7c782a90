#pragma once

#include <string>

namespace ccdt::tools {

enum class Tone { good, bad, note };

/// A text in color if standard output is a terminal. `NO_COLOR` (no-color.org) and `TERM=dumb` switch colors off.
std::string toned(const std::string& text, Tone tone);

}  // namespace ccdt::tools
