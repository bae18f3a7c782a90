#pragma once

#include <string>
#include <string_view>

namespace ccdt::tools {

enum class Tone { good, bad, note };

/// Makes a text safe for a terminal. Texts may contain names and contents of files, whose control characters could take
/// over a terminal. All control characters except line feeds and tabs, and those that turn the direction of text, are
/// escaped as in JSON: "\u001b". Bytes that are not UTF-8 are written as "\x9b".
std::string printable(std::string_view text);

/// Prints a text to standard output, `printable`.
void print(std::string_view text);

/// The same in color if standard output is a terminal. `NO_COLOR` (no-color.org) and `TERM=dumb` switch colors off.
void print(std::string_view text, Tone tone);

/// Prints a line to standard error, `printable`.
void print_error_line(std::string_view text);

/// \throw OutputError  something that was printed could not be written
void flush_output();

}  // namespace ccdt::tools
