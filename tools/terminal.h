#pragma once

#include <string>
#include <string_view>

namespace ccdt::tools {

enum class Tone { good, bad, note };

/// The text as a terminal may get it. Texts hold names and contents of files, which could take over a terminal by
/// control characters: all except line feeds and tabs are written as JSON does, "\u001b".
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
